"""The largest push that a simulated robot survives, over what the pendulum allows.

By bisection, for 8 directions, 5 phases of single support and standing, left and right stance:

    python benchmarks/push_recovery.py --robot talos --jobs 4

A cell counts up to its smallest push that was not survived: below the bisection's result a grid of
smaller pushes is tried too, so that no lucky island counts. At the end it prints a table and draws
a polar plot over the bound (`preview_walk.capturability.bound`), `pushes.png` in the folder.

Survived: the robot walks on, or stands again, for 6 s after the push. Angles are in degrees from
straight ahead towards the stance foot's side: 90 is outward, 270 inward.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from math import nan, radians
from typing import Any, get_args

import numpy as np
from campaign import make_parser, run
from matplotlib.figure import Figure
from push_bound_table import GAITS, own_limits
from push_walks import pushed

import preview_walk as pw
from preview_walk import Answer, largest_impulse

ANGLES = tuple(range(0, 360, 45))
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9, None)
LARGEST = 2.0
"""The search ends at this impulse per mass (N·s/kg)."""
PRECISION = 0.01
"""And the bisection at this difference (N·s/kg)."""
ISLANDS = 6
"""Smaller pushes that are tried too."""

Cell = dict[str, Any]
"""robot, stance foot, share of single support (None: standing), angle (degrees)."""


def cells(robot: str, shares: list[float | None], angles: list[int]) -> Iterator[Cell]:
    """Yield the grid; who stands has no stance foot, and the left one's side is outward."""
    for share in shares:
        for stance in ("left",) if share is None else ("left", "right"):
            for angle in angles:
                yield {"robot": robot, "stance": stance, "share": share, "angle": angle}


def study(given: argparse.Namespace) -> pw.Study:
    """Return the search for the largest push of each cell."""
    shares = [None if s == "standing" else float(s) for s in given.shares.split(",")]
    angles = [int(angle) for angle in given.angles.split(",")]
    mass = pw.load_robot(given.robot).mass
    margin = pw.Margin("impulse", 0.0, LARGEST * mass, PRECISION * mass, ISLANDS)
    return pw.Study(
        list(cells(given.robot, shares, angles)), pushed, margin=margin, name="push recovery"
    )


def bounds(robot: str, share: float | None, angle: int) -> list[float]:
    """Return the pendulum's largest impulses (N·s).

    With CoP alone, steps, steps and timing in stated limits, steps and timing in recovery's own.
    """
    gait, at, answers = GAITS[robot.upper()], radians(angle), get_args(Answer)
    stated = [largest_impulse(gait, share, at, answer) for answer in answers]
    return [*stated, largest_impulse(own_limits(robot.upper()), share, at, answers[-1])]


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the table and draw the polar plot."""
    found = {
        (None if row.share != row.share else row.share, row.angle, row.stance): row
        for row in results.table.itertuples()
    }
    shares = [share for share in SHARES if any(key[0] == share for key in found)]
    figure = Figure(figsize=(4 * len(shares), 4.5), layout="constrained")
    panels = figure.subplots(1, len(shares), squeeze=False, subplot_kw={"projection": "polar"})
    print(
        f"{given.robot}: largest impulse (N·s), left / right stance (bounds a / b / c / d), shares"
    )
    ratios = []
    for share, axes in zip(shares, panels[0], strict=True):
        angles = sorted({key[1] for key in found if key[0] == share})
        limit = {angle: bounds(given.robot, share, angle) for angle in angles}
        title = "standing" if share is None else f"{100 * share:.0f} %"
        for angle in angles:
            rows = [found.get((share, angle, stance)) for stance in ("left", "right")]
            values = [row.margin for row in rows if row is not None]
            ratios.append(min(values) / np.array(limit[angle]))
            print(line(title, angle, rows, limit[angle]))
        draw(axes, angles, {key[1:]: row for key, row in found.items() if key[0] == share}, limit)
        axes.set_title(title)
    figure.suptitle(
        f"{given.robot}: largest push (N·s), left stance blue, right stance orange; "
        "bounds: dotted CoP alone (a), dashed footholds free (b), "
        "dash-dotted their times too (c), grey (c) in recovery's own limits (d)"
    )
    figure.savefig(given.out / "pushes.png", dpi=110)
    means = " / ".join(f"{mean:.2f}" for mean in np.mean(ratios, axis=0))
    print(f"mean shares, of the weaker stance, of (a) / (b) / (c) / (d): {means}")
    return 0


def line(title: str, angle: int, rows: list[Any], limit: list[float]) -> str:
    """Return a direction's line of the table."""
    there = [row for row in rows if row is not None]
    text = " / ".join(f"{row.margin:5.1f}" for row in there)
    bound = " / ".join(f"{value:5.1f}" for value in limit)
    least = min(row.margin for row in there)
    share_of = " / ".join(f"{least / value:.2f}" for value in limit)
    islands = sum(row.islands for row in there)
    note = f"  {islands} islands" if islands else ""
    return f"  {title:>8} {angle:4d}  {text:>13}  ({bound})  {share_of}{note}"


def draw(
    axes: Any, angles: list[int], found: dict[Any, Any], limit: dict[int, list[float]]
) -> None:
    """Draw what is survived over the bounds."""
    ring = [*angles, angles[0]]
    turn = [radians(angle) for angle in ring]
    for k, (style, colour) in enumerate(((":", "k"), ("--", "k"), ("-.", "k"), ("-", "0.7"))):
        axes.plot(turn, [limit[a][k] for a in ring], ls=style, color=colour, lw=0.8)
    for stance, colour in (("left", "#0072B2"), ("right", "#E69F00")):
        margins = [getattr(found.get((a, stance)), "margin", nan) for a in ring]
        axes.plot(turn, margins, color=colour, marker="o", ms=3)
    axes.set_theta_zero_location("N")


def main() -> int:
    """Search, then report."""
    parser = make_parser(__doc__, "push_recovery")
    parser.add_argument("--robot", default="talos", choices=[name.lower() for name in GAITS])
    parser.add_argument("--shares", default="0.1,0.3,0.5,0.7,0.9,standing")
    parser.add_argument("--angles", default=",".join(map(str, ANGLES)))
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
