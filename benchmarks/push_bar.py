"""Whether a simulated robot survives what a controller that keeps its footholds never could.

    python benchmarks/push_bar.py --robot talos

Every cell of `push_recovery.py` (8 directions, 5 phases of single support and standing, left and
right stance) is pushed with three shares of its bar; what falls between them only the finer sizes
of `push_recovery.py` show. The bar is the pendulum's bound with the footholds kept, (a); straight
outward, and sideways on a stand, 0.75 of its bound with the footholds free, (b); in between, on a
stand, the smaller of the two. The command prints the cells that fell, and fails where there are
any.

The bound's force acts at the CoM, the push on the base, which is near it. `--body torso_2_link`
pushes TALOS's chest instead, `--body torso_link` G1's, where it tips the trunk over too.
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from math import radians

from push_bound_table import GAITS
from push_recovery import ANGLES, SHARES, Cell, cells, survives
from tqdm import tqdm

from preview_walk import largest_impulse

OF_BAR = (0.6, 0.8, 1.0)
"""Shares of the bar that are tried."""

OUTWARD = 0.75
"""Share of (b) that is asked for where the legs cannot cross."""


def bar(cell: Cell) -> float:
    """Return the impulse (N·s) that a cell should survive."""
    robot, _, share, angle = cell
    gait, towards = GAITS[robot.upper()], radians(angle)
    kept = largest_impulse(gait, share, towards, "cop")
    free = largest_impulse(gait, share, towards, "steps")
    if angle == 90 or (share is None and angle == 270):
        return OUTWARD * free
    return min(kept, OUTWARD * free) if share is None and angle % 180 else kept


def tried(push: tuple[Cell, float, str | None]) -> bool:
    """Return whether a cell survives an impulse (N·s) on a body; for the pool."""
    return survives(*push)


def main() -> int:
    """Push every cell; return how many fell at one of the shares at least."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="talos", choices=[name.lower() for name in GAITS])
    parser.add_argument("--jobs", type=int, default=None, help="processes (default: all cores)")
    parser.add_argument("--body", help="body that is pushed (default: the base)")
    given = parser.parse_args()
    grid = list(cells(given.robot, list(SHARES), list(ANGLES)))
    bars = [bar(cell) for cell in grid]
    pushes = [
        (cell, of * size, given.body)
        for cell, size in zip(grid, bars, strict=True)
        for of in OF_BAR
    ]
    with ProcessPoolExecutor(given.jobs) as pool:
        stood = list(tqdm(pool.map(tried, pushes), total=len(pushes), unit="push"))
    fell = 0
    for k, (cell, size) in enumerate(zip(grid, bars, strict=True)):
        outcome = stood[k * len(OF_BAR) : (k + 1) * len(OF_BAR)]
        if all(outcome):
            continue
        fell += 1
        _, stance, share, angle = cell
        phase = "standing" if share is None else f"{100 * share:.0f} %, {stance} stance"
        words = [
            f"{f:g}: {'stood' if ok else 'fell'}" for f, ok in zip(OF_BAR, outcome, strict=True)
        ]
        print(f"{phase}, {angle} degrees, of the bar of {size:.1f} N·s  {', '.join(words)}")
    print(f"{given.robot}: {len(grid) - fell} of {len(grid)} cells past the bar, ", end="")
    print(f"{sum(stood)} of {len(stood)} pushes survived")
    return fell


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
