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
from math import radians
from typing import Any

from campaign import make_parser, run
from push_bound_table import GAITS
from push_recovery import ANGLES, SHARES, Cell, cells
from push_walks import pushed

import preview_walk as pw
from preview_walk import largest_impulse

OF_BAR = (0.6, 0.8, 1.0)
"""Shares of the bar that are tried."""

OUTWARD = 0.75
"""Share of (b) that is asked for where the legs cannot cross."""


def bar(cell: Cell) -> float:
    """Return the impulse (N·s) that a cell should survive."""
    share, angle = cell["share"], cell["angle"]
    gait, towards = GAITS[cell["robot"].upper()], radians(angle)
    kept = largest_impulse(gait, share, towards, "cop")
    free = largest_impulse(gait, share, towards, "steps")
    if angle == 90 or (share is None and angle == 270):
        return OUTWARD * free
    return min(kept, OUTWARD * free) if share is None and angle % 180 else kept


def tried(of_bar: float, **cell: Any) -> pw.Record:
    """Return the record of a push of a share of the bar."""
    return pushed(**cell)


def study(given: argparse.Namespace) -> pw.Study:
    """Return the pushes of every cell."""
    rows = [
        {**cell, "body": given.body or "", "of_bar": of, "impulse": of * bar(cell)}
        for cell in cells(given.robot, list(SHARES), list(ANGLES))
        for of in OF_BAR
    ]
    return pw.Study(rows, tried, name="push bar")


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the cells that fell at one of the shares at least; return 1 where there are any."""
    fell = 0
    groups = results.table.groupby(["share", "stance", "angle"], dropna=False, sort=False)
    for (share, stance, angle), rows in groups:
        if rows["success"].all():
            continue
        fell += 1
        phase = "standing" if share != share else f"{100 * share:.0f} %, {stance} stance"
        size = float((rows["impulse"] / rows["of_bar"]).iloc[0])
        words = [
            f"{row.of_bar:g}: {'stood' if row.success else 'fell'}" for row in rows.itertuples()
        ]
        print(f"{phase}, {angle} degrees, of the bar of {size:.1f} N·s  {', '.join(words)}")
    stood = int(results.table["success"].sum())
    print(f"{given.robot}: {len(groups) - fell} of {len(groups)} cells past the bar, ", end="")
    print(f"{stood} of {len(results)} pushes survived")
    return 1 if fell else 0


def main() -> int:
    """Push every cell; return 1 where one fell."""
    parser = make_parser(__doc__, "push_bar")
    parser.add_argument("--robot", default="talos", choices=[name.lower() for name in GAITS])
    parser.add_argument("--body", help="body that is pushed (default: the base)")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
