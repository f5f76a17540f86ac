"""TALOS walks 20 steps in MuJoCo: figures, the record and a picture.

python examples/walk_talos.py --out walk_talos.png
"""

import argparse
from pathlib import Path

import preview_walk as pw


def main() -> None:
    """Walk, print the figures, save the record and draw the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="walk_talos.png", help="the picture to write")
    out = Path(parser.parse_args().out)

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.25, step_width=robot.step_width, step_time=0.9)
    record = pw.simulate(robot, planner.generate_footsteps(20, ramp=2))

    print(record.summary())
    record.save(out.with_suffix(".npz"))
    pw.plot(record, out)
    print(f"wrote {out.with_suffix('.npz')} and {out}")


if __name__ == "__main__":
    main()
