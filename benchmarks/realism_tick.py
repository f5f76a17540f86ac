"""What sensors and an estimator add to a tick: two walks of one robot, in turns.

    python benchmarks/realism_tick.py --robot talos

Prints the median tick (ms) with perfect state and with `--realism`, and their ratio; reading the
sensors is part of the tick.
"""

from __future__ import annotations

import argparse

import numpy as np

import preview_walk as pw

STRETCH, STRETCHES = 0.2, 30
"""Seconds that a walk goes on before the other one does, and how many times."""


def main() -> None:
    """Walk and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="talos", help="of the catalogue (default talos)")
    parser.add_argument("--realism", default="lab", help="lab or field (default lab)")
    given = parser.parse_args()
    robot = pw.load_robot(given.robot)
    walks = [
        pw.Walk.standing(robot, realism=pw.read_realism(name)) for name in ("none", given.realism)
    ]
    for walk in walks:
        walk.command(0.5, 0.0, 0.2)
        walk.run(until=1.0)
    for number in range(1, STRETCHES + 1):
        for walk in walks:
            walk.run(until=1.0 + STRETCH * number)
    perfect, real = (
        float(np.median(record.tick_time[record.time >= 1.0]))
        for record in (walk.record() for walk in walks)
    )
    print(
        f"{given.robot}: {1e3 * perfect:.3f} ms, {given.realism} {1e3 * real:.3f} ms, "
        f"{real / perfect:.2f} times"
    )


if __name__ == "__main__":
    main()
