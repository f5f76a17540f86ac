"""Plans laid on a ground: every sole gets the height and the tilt of what is under the whole of it.

A foothold across an edge moves to the nearest place where the whole sole lies on one plane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import cos, sin

import numpy as np

from preview_walk.arguments import angle, instance_of, number_from_zero
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.clearing import clearing_shape
from preview_walk.footsteps.findings import Finding
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.footsteps.swing_shape import PLAIN, SwingShape
from preview_walk.geometry.poses import Heading, compose, heading_of, pose_at
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Ground, Plane
from preview_walk.types import Array, Foot, other

UNEVEN = 0.003
"""A place is plane when the ground under the sole is nowhere further (m) from the plane of the
nearest fit: what a sole of rubber takes up."""

ROUGH = 0.02
"""Where no place is plane, the least uneven one will do up to this (m): no edge is so low that a
sole could not lie across it."""

OFF = 0.01
"""A sole whose height, or whose ends', differ from the ground's by less (m) lies on it."""

REACH = 0.2
"""A foothold may move this far (m) along its heading, and half as far aside."""

CLEAR = 0.01
"""A sole keeps this distance (m) from an edge."""

_GRID = np.array(list(product((-1.0, -0.5, 0.0, 0.5, 1.0), (-1.0, 0.0, 1.0))))
"""Where the ground is looked at under a sole, in halves of its length and width."""

_MOVES = np.array(
    sorted(
        product(np.linspace(-REACH, REACH, 41), np.linspace(-0.5 * REACH, 0.5 * REACH, 11)),
        key=lambda move: (round(move[0] ** 2 + 2.0 * move[1] ** 2, 9), move),
    )
)
"""Moves (along, aside), m, the shortest first: none."""


def lay_on(
    plan: PlanLike, ground: Ground, limits: GaitLimits, overhang: float = 0.0
) -> FootstepPlan:
    """Return the plan with its soles on a ground, at the same times, its swings clear of edges.

    Args:
        plan: the walk, as on level ground; its heights and tilts are left.
        ground: what it is to walk on.
        limits: bounds of a step, which one that is moved must keep, and the sole sizes.
        overhang: by how much the soles may stand over edges, m.

    Raises:
        InvalidInput: no place near a foothold has room for the whole sole; says which step.
    """
    flat, limits = as_plan(plan), instance_of(limits, GaitLimits, "limits")
    layer = _Layer(ground, limits, number_from_zero(overhang, "overhang", "m"))
    steps: list[Footstep] = []
    stood: dict[Foot, Array] = {}
    for number, step in enumerate(flat, -1):
        stance = stood.get(other(step.foot)) if number > 0 else None
        pose = layer.place(step, stance)
        if pose is None:
            raise _no_room(step, number, limits.sole)
        steps.append(layer.laid(step, pose, stood.get(step.foot)))
        stood[step.foot] = pose
    return FootstepPlan(steps, flat.weight_shift)


def relay(
    plan: FootstepPlan,
    current: FootstepPlan,
    ground: Ground,
    limits: GaitLimits,
    uneven: float = UNEVEN,
) -> FootstepPlan:
    """Return a plan with those soles on the ground that the current plan does not have.

    What has no room for a sole is stepped on at its highest: a step after a push must land. A swing
    that lands elsewhere than the current plan has it keeps its shape: it may be under way.

    Args:
        plan: the walk to come.
        current: the walk up to now, which lies on the ground.
        ground: what it is to walk on.
        limits: bounds of a step, and the sole sizes.
        uneven: how far (m) the ground under a sole may be from its plane before the sole moves.
    """
    first = _first_new(plan, current)
    if first == len(plan):
        return plan
    layer = _Layer(ground, limits, 0.0, uneven)
    stood: dict[Foot, Array] = {step.foot: step.pose for step in plan[:first]}
    shapes = {(step.foot, step.lift): step.swing for step in current.steps}
    steps: list[Footstep] = []
    for step in plan[first:]:
        pose = layer.place(step, stood[other(step.foot)])
        if pose is None:
            pose = layer.on_top(step)
        shape = shapes.get((step.foot, step.lift))
        if shape is None:
            steps.append(layer.laid(step, pose, stood[step.foot]))
        else:
            steps.append(replace(step, pose=pose, swing=shape))
        stood[step.foot] = pose
    return FootstepPlan([*plan[:first], *steps], plan.weight_shift)


def on_plane(plan: FootstepPlan, foot: Foot, t: float, plane: Plane) -> FootstepPlan:
    """Return the plan whose steps lie on a plane, from the one on which a foot stands or lands.

    Args:
        plan: the walk.
        foot: whose last step that has lifted by time t is the first on the plane.
        t: now, s.
        plane: the ground as it is taken to be from there on.
    """
    first = max(k for k, step in enumerate(plan) if step.foot == foot and step.lift <= t)
    steps: list[Footstep] = [*plan[:first]]
    for step in plan[first:]:
        x, y, yaw = heading_of(step.pose)
        c, s = cos(yaw), sin(yaw)
        rise = (plane.ahead * c + plane.left * s, plane.left * c - plane.ahead * s)
        pose = _lying((x, y, yaw), np.array((float(plane.height(x, y)), *rise)))
        steps.append(replace(step, pose=pose))
    return FootstepPlan(steps, plan.weight_shift)


def swung(plan: FootstepPlan, current: FootstepPlan, shape: SwingShape) -> FootstepPlan:
    """Return the plan whose plain swings that the current plan does not have are of this shape."""
    first = _first_new(plan, current)
    if first == len(plan):
        return plan
    later = [replace(s, swing=shape) if s.swing == PLAIN else s for s in plan[first:]]
    return FootstepPlan([*plan[:first], *later], plan.weight_shift)


def _first_new(plan: FootstepPlan, current: FootstepPlan) -> int:
    """Return the index of the first step that the current plan does not have, or the length."""
    known = {id(step) for step in current}
    return next((k for k, s in enumerate(plan) if k > 1 and id(s) not in known), len(plan))


def ground_findings(plan: FootstepPlan, ground: Ground, sole: Sole) -> Iterator[Finding]:
    """Yield the soles of a plan that do not lie on a ground: above, below, tilted, across an edge.

    Args:
        plan: the walk.
        ground: what it is to walk on.
        sole: half sizes of the soles, m.
    """
    for number, step in enumerate(plan, -1):
        (plane,), (uneven,) = _fits([heading_of(step.pose)], ground, sole)
        here = _lying(heading_of(step.pose), plane, uneven)
        rise = float(step.pose[2, 3] - here[2, 3])
        tilt = float(np.arccos(np.clip(step.pose[:3, 2] @ here[:3, 2], -1.0, 1.0)))
        if uneven > ROUGH:
            corners = sole.corners(step.pose)
            depth = float(np.ptp(ground.height(corners[:, 0], corners[:, 1])))
            what = f"stands across an edge of the ground, {depth:.3f} m deep"
        elif abs(rise) > OFF:
            what = f"is {abs(rise):.3f} m {'above' if rise > 0.0 else 'below'} the ground"
        elif tilt * sole.half_length > OFF:
            what = f"is tilted by {angle(tilt)} against the ground"
        else:
            continue
        who = f"step {number}" if number > 0 else f"the {step.foot} sole at the start"
        yield Finding(step.land, f"{who} {what}", max(number, 0) or None, "ground")


@dataclass(frozen=True)
class _Layer:
    """What all steps of a plan are laid on and with; arguments as of `lay_on`."""

    ground: Ground
    limits: GaitLimits
    overhang: float
    uneven: float = UNEVEN

    @property
    def sole(self) -> Sole:
        """What of the sole must be on the ground."""
        sole, over = self.limits.sole, self.overhang
        return Sole(max(sole.half_length - over, 1e-3), max(sole.half_width - over, 1e-3))

    def place(self, step: Footstep, stance: Array | None) -> Array | None:
        """Return the pose (4, 4) of a step's sole on the ground, moved off edges; None: nowhere.

        `stance`: pose (4, 4) of the other sole, of which a moved one stays in reach.
        """
        goal = heading_of(step.pose)
        (plane,), (least,) = _fits([goal], self.ground, self.sole)
        if least <= self.uneven:
            return _lying(goal, plane, least)
        places = [compose(goal, *move) for move in _MOVES.tolist()]
        planes, uneven = _fits(places, self.ground, self.sole)
        far = np.hypot(*_MOVES.T)
        for k in [*np.flatnonzero(uneven <= self.uneven), *np.argsort(uneven + 0.02 * far)]:
            if uneven[k] > ROUGH:
                break
            pose = _lying(places[k], planes[k], uneven[k])
            if stance is None or self.limits.problem(step.foot, stance, pose) is None:
                return pose
        return None

    def on_top(self, step: Footstep) -> Array:
        """Return the pose (4, 4) of a level sole on the highest point under it."""
        x, y, yaw = heading_of(step.pose)
        corners = self.sole.corners(pose_at(x, y, yaw))
        top = self.ground.height(corners[:, 0], corners[:, 1]).max()
        return pose_at(x, y, yaw, float(top))

    def laid(self, step: Footstep, pose: Array, start: Array | None) -> Footstep:
        """Return the step to a pose, from where the foot stood, its swing clear of the ground."""
        if start is None or step.type == "stance":
            return replace(step, pose=pose)
        shape = clearing_shape(start, pose, self.ground, self.limits.sole)
        return replace(step, pose=pose, swing=shape)


def _fits(places: Sequence[Heading], ground: Ground, sole: Sole) -> tuple[Array, Array]:
    """Return the plane of the ground under soles at N places, and how uneven it is there.

    Returns:
        (N, 3) height at the centre (m), rise ahead and to the left; and (N,) the largest distance
        of the ground from that plane, m.
    """
    local = _GRID * (sole.half_length + CLEAR, sole.half_width + CLEAR)
    x0, y0, yaw = np.array(places).T[:, :, None]
    x = x0 + np.cos(yaw) * local[:, 0] - np.sin(yaw) * local[:, 1]
    y = y0 + np.sin(yaw) * local[:, 0] + np.cos(yaw) * local[:, 1]
    heights = ground.height(x, y)
    columns = np.column_stack([np.ones(len(local)), local])
    planes = heights @ np.linalg.pinv(columns).T
    return planes, np.abs(planes @ columns.T - heights).max(axis=1)


def _lying(place: Heading, plane: Array, uneven: float = 0.0) -> Array:
    """Return the pose (4, 4) of a sole at a place, on a plane (3,) and so uneven as of `_fits`."""
    x, y, yaw = place
    z, ahead, left = plane.tolist()
    if uneven > UNEVEN:
        z += uneven  # it lies on the highest points
    c, s = cos(yaw), sin(yaw)
    normal = np.array((-ahead * c + left * s, -ahead * s - left * c, 1.0))
    normal /= np.linalg.norm(normal)
    forward = np.array((c, s, ahead))
    forward /= np.linalg.norm(forward)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = forward, np.cross(normal, forward), normal
    pose[:3, 3] = x, y, z
    return pose


def _no_room(step: Footstep, number: int, sole: Sole) -> InvalidInput:
    """Return the error that a foothold has no room."""
    what = f"step {number}" if number > 0 else f"the {step.foot} foot at the start"
    return InvalidInput(
        f"the ground has no plane place of {2.0 * sole.half_length:.3f} x "
        f"{2.0 * sole.half_width:.3f} m within {REACH} m of where {what} is to stand, "
        f"({step.pos[0]:.3f}, {step.pos[1]:.3f}) m.",
        "ground",
    )
