"""The largest push the pendulum survives, for two robots, beside reference figures.

The reference was computed independently of this package and printed to 0.1 N·s: largest impulse
(N·s) of a push of 0.2 s, by CoP alone / with free footholds / with free footholds and timing.

    python benchmarks/push_bound_table.py
"""

from __future__ import annotations

import time
from typing import get_args

from preview_walk.capturability.bound import Answer, Direction, PushGait, largest_impulse
from preview_walk.geometry.support import Sole

TALOS = PushGait(
    mass=90.3,
    com_height=0.87,
    sole=Sole(0.105, 0.065),
    step_width=0.17,
    step_length=0.2,
    single_support=0.7,
    double_support=0.2,
    forward=0.6,
    backward=0.4,
    min_width=0.14,
    max_width=0.55,
    min_swing_time=0.35,
    max_swing_time=1.0,
    swing_speed=2.5,
)
G1 = PushGait(
    mass=33.3,
    com_height=0.62,
    sole=Sole(0.085, 0.03),
    step_width=0.237,
    step_length=0.15,
    single_support=0.6,
    double_support=0.15,
    forward=0.45,
    backward=0.3,
    min_width=0.12,
    max_width=0.45,
    min_swing_time=0.3,
    max_swing_time=0.9,
    swing_speed=2.5,
)
GAITS = {"TALOS": TALOS, "G1": G1}

Cell = tuple[float, float, float]
REFERENCE: dict[str, dict[float | None, tuple[Cell, ...]]] = {
    "TALOS": {
        0.1: ((46.6, 67.7, 131.9), (46.0, 72.5, 128.6), (29.0, 33.0, 35.5), (29.5, 48.7, 111.0)),
        0.3: ((48.3, 82.1, 137.5), (47.4, 89.8, 179.6), (30.2, 36.5, 40.6), (30.9, 61.8, 155.3)),
        0.5: ((51.1, 105.1, 147.7), (49.6, 117.4, 178.6), (32.1, 42.2, 48.5), (33.2, 82.6, 149.6)),
        0.7: ((55.5, 142.0, 156.4), (53.1, 161.7, 174.1), (35.1, 51.3, 57.6), (37.0, 115.9, 140.5)),
        0.9: ((62.5, 122.9, 152.9), (58.8, 98.4, 183.4), (40.0, 63.3, 72.2), (42.9, 101.5, 125.9)),
        None: ((43.7, 68.7, 129.5), (43.7, 60.4, 104.8), (62.5, 62.5, 64.5)),
    },
    "G1": {
        0.1: ((17.2, 24.3, 51.9), (17.0, 26.1, 45.6), (6.9, 9.6, 10.3), (7.1, 12.0, 35.3)),
        0.3: ((17.7, 29.2, 54.2), (17.5, 32.0, 63.5), (7.6, 11.9, 13.0), (8.0, 15.9, 53.4)),
        0.5: ((18.6, 37.0, 57.8), (18.2, 41.7, 66.0), (8.7, 15.7, 17.1), (9.3, 22.1, 57.6)),
        0.7: ((20.0, 49.6, 60.6), (19.3, 57.2, 64.9), (10.6, 21.7, 23.2), (11.5, 32.1, 51.5)),
        0.9: ((20.5, 46.0, 59.0), (20.4, 37.9, 68.5), (13.5, 30.6, 32.9), (15.0, 38.5, 41.8)),
        None: ((16.3, 21.9, 46.5), (16.3, 20.1, 37.3), (28.5, 28.5, 29.1)),
    },
}
"""Robot, share of single support (None: standing), then a cell for each direction in order."""


def main() -> None:
    """Print the tables, ours over the reference, and the largest deviation of each column."""
    answers, directions = get_args(Answer), get_args(Direction)
    worst = dict.fromkeys(answers, 0.0)
    begin = time.perf_counter()
    for name, table in REFERENCE.items():
        print(name)
        print(f"  {'':<12}" + "".join(f"{direction:<26}" for direction in directions))
        for share, cells in table.items():
            rows: tuple[list[str], list[str]] = ([], [])
            for direction, cell in zip(directions, cells, strict=False):
                ours = [
                    largest_impulse(GAITS[name], share, direction, answer) for answer in answers
                ]
                for answer, mine, theirs in zip(answers, ours, cell, strict=True):
                    worst[answer] = max(worst[answer], abs(mine / theirs - 1.0))
                for row, values in zip(rows, (ours, cell), strict=True):
                    row.append(" / ".join(f"{value:.1f}" for value in values))
            label = "standing" if share is None else f"{100 * share:.0f} %"
            for head, row in zip((label, "reference"), rows, strict=True):
                print(f"  {head:<12}" + "".join(f"{text:<26}" for text in row), flush=True)
    print(f"largest deviation from the reference, {time.perf_counter() - begin:.0f} s:")
    for answer, deviation in worst.items():
        print(f"  {answer:<18}{100 * deviation:.2f} %")


if __name__ == "__main__":
    main()
