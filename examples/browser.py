"""A short walk up stairs as one HTML file, to be played in any browser; or live with --live.

python examples/browser.py --out walk.html
"""

import argparse

import preview_walk as pw


def main() -> None:
    """Walk and write the page, or walk in the browser by what its visitor asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="walk.html", help="the page to write")
    parser.add_argument("--live", action="store_true", help="walk live instead, until Ctrl-C")
    given = parser.parse_args()

    robot = pw.load_robot("talos")
    stairs = pw.stairs(0.1, 0.3, 2)  # rise, m; tread, m; count
    walk = pw.Walk.standing(robot, ground=stairs)
    if given.live:
        pw.show(walk)
        print(walk.record().summary())
        return
    walk.command(0.4, 0.0, 0.0)  # m/s forward, m/s left, rad/s left
    walk.run(until=3.0)
    walk.push((0.0, 80.0, 0.0), 0.2)  # N, world; s
    walk.run(until=4.0)
    walk.command(0.0, 0.0, 0.0)
    path = pw.export_html(walk.run().record(), given.out)
    print(f"wrote {path}, {path.stat().st_size / 1e6:.1f} MB; open it in any browser")


if __name__ == "__main__":
    main()
