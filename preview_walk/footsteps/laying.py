"""Plans laid on a ground: every sole gets the height and the tilt of what is under the whole of it.

A foothold across an edge moves to the nearest place where the whole sole lies on one plane.
"""

from __future__ import annotations

from itertools import product
from math import cos, sin

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.poses import Heading, compose, heading_of
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Ground
from preview_walk.types import Array

UNEVEN = 0.003
"""A place is plane when the ground under the sole is nowhere further (m) from the plane of the
nearest fit: what a sole of rubber takes up."""

REACH = 0.2
"""A foothold may move this far (m) along its heading, and half as far aside."""

CLEAR = 0.01
"""A sole keeps this distance (m) from an edge."""

_GRID = np.array(list(product((-1.0, -0.5, 0.0, 0.5, 1.0), (-1.0, 0.0, 1.0))))
"""Where the ground is looked at under a sole, in halves of its length and width."""


def lay_on(plan: PlanLike, ground: Ground, sole: Sole) -> FootstepPlan:
    """Return the plan with its soles on a ground, at the same times.

    Args:
        plan: the walk, as on level ground; its heights and tilts are left.
        ground: what it is to walk on.
        sole: half sizes of the soles, m.

    Raises:
        InvalidInput: no place near a foothold has room for the whole sole; says which step.
    """
    flat = as_plan(plan)
    steps = [
        Footstep(step.foot, _placed(step, number, ground, sole), step.lift, step.land, step.type)
        for number, step in enumerate(flat, -1)
    ]
    return FootstepPlan(steps, flat.weight_shift)


def _placed(step: Footstep, number: int, ground: Ground, sole: Sole) -> Array:
    """Return the pose (4, 4) of a step's sole on the ground, moved off edges."""
    goal = heading_of(step.pose)
    for along, aside in _MOVES:
        pose = sole_on(compose(goal, along, aside), ground, sole)
        if pose is not None:
            return pose
    what = f"step {number}" if number > 0 else f"the {step.foot} foot at the start"
    raise InvalidInput(
        f"the ground has no plane place of {2.0 * sole.half_length:.3f} x "
        f"{2.0 * sole.half_width:.3f} m within {REACH} m of where {what} is to stand, "
        f"({goal[0]:.3f}, {goal[1]:.3f}) m.",
        "ground",
    )


def sole_on(place: Heading, ground: Ground, sole: Sole) -> Array | None:
    """Return the pose (4, 4) of a sole that lies on the ground at a place, or None across an edge.

    Args:
        place: x, y (m) and heading (rad) of the sole's centre.
        ground: what it lies on.
        sole: half sizes, m.
    """
    x, y, yaw = place
    c, s = cos(yaw), sin(yaw)
    size = (sole.half_length + CLEAR, sole.half_width + CLEAR)
    local = _GRID * size
    world = local @ np.array(((c, s), (-s, c))) + (x, y)
    heights = ground.height(world[:, 0], world[:, 1])
    columns = np.column_stack([np.ones(len(local)), local])
    (z, ahead, left), *_ = np.linalg.lstsq(columns, heights, rcond=None)
    if np.abs(columns @ (z, ahead, left) - heights).max() > UNEVEN:
        return None
    normal = np.array((-ahead * c + left * s, -ahead * s - left * c, 1.0))
    normal /= np.linalg.norm(normal)
    forward = np.array((c, s, ahead))
    forward /= np.linalg.norm(forward)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = forward, np.cross(normal, forward), normal
    pose[:3, 3] = x, y, z
    return pose


def _moves() -> list[tuple[float, float]]:
    """Return moves (along, aside), m, the shortest first."""
    along = np.arange(-REACH, REACH + 1e-9, 0.01)
    aside = np.arange(-0.5 * REACH, 0.5 * REACH + 1e-9, 0.02)
    moves = [(round(float(a), 3), round(float(b), 3)) for a in along for b in aside]
    return sorted(moves, key=lambda move: (move[0] ** 2 + 2.0 * move[1] ** 2, move))


_MOVES = _moves()
