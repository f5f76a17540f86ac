"""Plans as others write them: lists of footsteps, the walking lab's dictionaries, a record's rows.

The lab's dictionary of a footstep holds its foot, its position, its landing time and its type; when
the foot lifts is not in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from preview_walk.arguments import MOST, finite_number, real_array, share_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import WEIGHT_SHIFT_TIME, FootstepPlan
from preview_walk.geometry.poses import as_pose, pose_at
from preview_walk.types import FEET, Array

DOUBLE_SUPPORT_RATIO = 0.2
"""Share of the time from one landing to the next in which both feet stand, where nothing is said:
what `FootstepPlanner` has."""


_ROWS = ("foot", "pose", "lift", "land")
"""Names of the arrays of `PlanRows`."""


class PlanRows(Protocol):
    """A plan as arrays, one row per footstep, the two standing soles first; as records hold it.

    Attributes:
        foot: (S,) 0 for the left foot, 1 for the right one.
        pose: (S, 4, 4) sole poses in the world, m.
        lift: (S,) lift times, s.
        land: (S,) landing times, s.
    """

    foot: NDArray[np.integer[Any]]
    pose: Array
    lift: Array
    land: Array


PlanLike = FootstepPlan | Sequence[Footstep | Mapping[str, Any]] | PlanRows
"""What `as_plan` reads."""


def as_plan(value: PlanLike, ratio: float = DOUBLE_SUPPORT_RATIO) -> FootstepPlan:
    """Return the plan that somebody gives in one of the forms there are.

    Args:
        value: a `FootstepPlan`, returned as it is; a sequence of `Footstep`; the walking lab's list
            of dictionaries with the keys foot ("left" or "right"), pos ((x, y) or (x, y, z) of the
            sole's centre, m), time (landing, s) and type ("stance" or "swing_end"), and, if need
            be, yaw (rad, else 0) and lift (s); or rows as a record holds them (`PlanRows`).
        ratio: where a dictionary has no lift, this share of the time since the landing before it
            is double support.

    Raises:
        InvalidInput: it is none of these, or no plan comes of it.
    """
    share_of(ratio, "ratio", "the step time")
    if isinstance(value, FootstepPlan):
        return value
    given: object = value
    try:
        if isinstance(given, Sequence) and not isinstance(given, str | bytes):
            return FootstepPlan(_from_items(given, ratio))
        if not isinstance(given, Footstep) and all(hasattr(given, name) for name in _ROWS):
            return _from_rows(given)
    except InvalidInput as error:
        raise InvalidInput(f"plan is none: {error}", argument="plan") from error
    raise InvalidInput(
        "plan must be a FootstepPlan, a sequence of footsteps or of the walking lab's "
        f"dictionaries, or a plan of a record, got {shown(value)}.",
        argument="plan",
    )


def _from_items(items: Sequence[object], ratio: float) -> Iterator[Footstep]:
    """Yield the footsteps of a list of footsteps or dictionaries."""
    landed = 0.0
    for number, item in enumerate(items):
        if isinstance(item, Footstep):
            step = item
        elif isinstance(item, Mapping):
            step = _from_dictionary(item, f"entry {number}", landed, ratio)
        else:
            raise InvalidInput(
                f"entry {number} must be a Footstep or a dictionary, got {shown(item)}.",
                argument="plan",
            )
        landed = step.land
        yield step


def _from_dictionary(item: Mapping[str, Any], name: str, landed: float, ratio: float) -> Footstep:
    """Return the footstep of one of the lab's dictionaries; the one before it `landed` then (s)."""
    missing = [key for key in ("foot", "pos", "time", "type") if key not in item]
    if missing:
        raise InvalidInput(
            f"{name} must have the key {missing[0]!r}, got {shown(item)}.", argument="plan"
        )
    place = real_array(item["pos"], f"pos of {name}", "(x, y) or (x, y, z) in m")
    if place.shape not in ((2,), (3,)):
        came = shown(item["pos"])
        raise InvalidInput(
            f"pos of {name} must be (x, y) or (x, y, z) in m, got {came}.", argument="plan"
        )
    x, y, z = (*place.tolist(), 0.0)[:3]
    yaw = finite_number(item.get("yaw", 0.0), f"yaw of {name}", "rad")
    land = finite_number(item["time"], f"time of {name}", "s")
    lift = land
    if item["type"] != "stance":
        lift = item.get("lift", landed + ratio * (land - landed))
    return Footstep(item["foot"], pose_at(x, y, yaw, z), lift, land, item["type"])


def _from_rows(rows: object) -> FootstepPlan:
    """Return the plan of a record's rows; a foot that goes twice was let to when it did."""
    form = "an array of numbers"
    feet, pose, lift, land = (real_array(getattr(rows, name), name, form) for name in _ROWS)
    count = len(feet) if feet.ndim == 1 else 0
    if not (
        2 <= count <= MOST
        and pose.shape == (count, 4, 4)
        and lift.shape == land.shape == (count,)
        and np.isin(feet, (0, 1)).all()
    ):
        raise InvalidInput(
            "its rows must have foot (S,) of 0 and 1, pose (S, 4, 4), lift (S,) and land (S,), "
            f"got {feet.shape}, {pose.shape}, {lift.shape} and {land.shape}.",
            argument="plan",
        )
    # The end of a plan is its last landing and a shift of weight; 1 ns takes off the rounding.
    end = getattr(rows, "end", None)
    shift = WEIGHT_SHIFT_TIME
    if end is not None and count > 2:
        shift = round(finite_number(end, "end", "s") - float(land[-1]), 9)
    steps = []
    for i, foot in enumerate(feet.astype(int).tolist()):
        kind: Literal["stance", "swing_end"] = "stance" if i < 2 else "swing_end"
        again = i > 2 and bool(feet[i] == feet[i - 1])
        sole = as_pose(pose[i], f"pose of row {i}")
        steps.append(Footstep(FEET[foot], sole, float(lift[i]), float(land[i]), kind, again))
    return FootstepPlan(steps, shift)
