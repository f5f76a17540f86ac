"""The largest push the pendulum survives, for two robots: in stated limits and in our own.

Largest impulse (N·s) of a push of 0.2 s, by CoP alone / with free footholds / with free footholds
and timing. First in the limits that a reference states, computed independently of this package and
printed to 0.1 N·s, below ours. They bound a pendulum with these limits, not every controller:
ours steps wider, quicker and with shorter double supports. So then, with `--own`, the bound of the
same pendulum in the limits of `preview_walk.stabilizer.step_limits`: what ours survives beyond it,
it survives by what the pendulum leaves out, the angular momentum of trunk and arms.

    python benchmarks/push_bound_table.py
    python benchmarks/push_bound_table.py --own --out docs/push_bounds.png
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from functools import cache
from typing import get_args

from matplotlib.figure import Figure

from preview_walk import Answer, Direction, PushGait, Sole, largest_impulse

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
"""The robots as the reference has them, with the limits of a step that it states."""

Cell = tuple[float, float, float]
"""The bound (N·s) of each answer."""

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


@cache
def own_limits(name: str) -> PushGait:
    """Return the same pendulum and walk with the limits that the controller's recovery steps by.

    The swing speed is a mean: of a foot that is at its top speed, over the rest of its way.
    """
    import preview_walk as pw

    gait = GAITS[name]
    robot = pw.load_robot(name.lower())
    limits = pw.step_limits(robot.leg_length, robot.step_width, robot.sole, gait.omega)
    shortest, longest = limits.swing_time
    return replace(
        gait,
        forward=limits.gait.forward,
        backward=limits.gait.backward,
        min_width=min(limits.gait.min_width, gait.step_width),
        max_width=limits.gait.max_width,
        min_swing_time=shortest,
        max_swing_time=longest,
        swing_speed=sum(pw.SPEED_SHARE) * limits.swing_speed,
        short_double_support=pw.SHORT_PAUSE,
    )


def described(gait: PushGait) -> str:
    """Return the limits of a step in one line."""
    pause = gait.short_double_support
    shown = gait.double_support if pause is None else pause
    return (
        f"{gait.forward:.3f} m ahead, {gait.backward:.3f} m behind, {gait.min_width:.3f} to "
        f"{gait.max_width:.3f} m wide, {gait.min_swing_time:.3f} to {gait.max_swing_time:.3f} s "
        f"in the air, {gait.swing_speed:.2f} m/s, {shown:.3f} s of double support"
    )


def row(gait: PushGait, share: float | None) -> list[tuple[float, ...]]:
    """Return the bound (N·s) of every answer, for every direction that a row of the table has.

    Standing, outward and inward are the same.
    """
    directions = get_args(Direction)[: 3 if share is None else 4]
    return [
        tuple(largest_impulse(gait, share, direction, answer) for answer in get_args(Answer))
        for direction in directions
    ]


Table = dict[float | None, list[Cell]]
"""A cell for each direction in order, for each share of single support."""


def draw(own: dict[str, Table], path: str) -> None:
    """Draw the bound with free footholds and times in the reference's limits and in our own."""
    figure = Figure(figsize=(11.0, 5.5), layout="constrained")
    axes = figure.subplots(len(own), 4, sharex=True, sharey="row", squeeze=False)
    for line, (name, table) in zip(axes, own.items(), strict=True):
        shares = [share for share in table if share is not None]
        for k, (axis, direction) in enumerate(zip(line, get_args(Direction), strict=True)):
            for cells, style, label in (
                (REFERENCE[name], "k--", "the reference's limits"),
                (table, "C0-", "the controller's own limits"),
            ):
                values = [cells[share][k][2] for share in shares]
                axis.plot(shares, values, style, marker="o", ms=3, label=label)
            axis.set_title(f"{name}, {direction}", fontsize=10)
            axis.grid(True, color="0.92")
        line[0].set_ylim(bottom=0.0)
        line[0].set_ylabel("impulse [N·s]")
    figure.supxlabel("share of single support", fontsize=10)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=2,
                  frameon=False)  # fmt: skip
    figure.savefig(path, dpi=100)


def main() -> None:
    """Print the tables, ours over the reference, and the largest deviation of each column."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--own", action="store_true", help="bounds in the controller's own limits")
    parser.add_argument("--out", help="a picture of the bounds in both limits; with --own")
    given = parser.parse_args()
    own = given.own
    found: dict[str, Table] = {}
    worst = dict.fromkeys(get_args(Answer), 0.0)
    begin = time.perf_counter()
    for name, table in REFERENCE.items():
        gait = own_limits(name) if own else GAITS[name]
        print(f"{name}: {described(gait)}")
        print(f"  {'':<12}" + "".join(f"{direction:<26}" for direction in get_args(Direction)))
        for share, cells in table.items():
            ours = row(gait, share)
            found.setdefault(name, {})[share] = ours
            for mine, theirs in zip(ours, cells, strict=True):
                for answer, a, b in zip(worst, mine, theirs, strict=True):
                    worst[answer] = max(worst[answer], abs(a / b - 1.0))
            label = "standing" if share is None else f"{100 * share:.0f} %"
            for head, values in ((label, ours), ("reference", cells)):
                words = (" / ".join(f"{value:.1f}" for value in cell) for cell in values)
                print(f"  {head:<12}" + "".join(f"{text:<26}" for text in words), flush=True)
    seconds = time.perf_counter() - begin
    if own and given.out:
        draw(found, given.out)
    print(f"largest difference from the reference, {seconds:.0f} s:")
    for answer, deviation in worst.items():
        print(f"  {answer:<18}{100 * deviation:.2f} %")


if __name__ == "__main__":
    main()
