"""A leg: which of its joints bend it, how long it is, and what it cannot do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.types import Array, Foot

LATERAL = 0.8
"""Least cosine between a joint's axis and the lateral direction for it to bend the leg."""

TILTED = 0.45
"""The same for a hip: its pitch axis may be tilted by 60 degrees."""


@dataclass(frozen=True)
class Leg:
    """A leg: its Pinocchio joints, three of which bend it.

    Attributes:
        joints: all of them, pelvis first.
        hip: the one that swings the thigh.
        knee: the one that bends the leg.
        ankle: the one that pitches the foot.
        bend: sign of a flexing knee's angle.
        length: sum of thigh, shank and foot, m.
        spare: joints that bend the leg besides, as a tarsus does; they are held.
        unplaced: directions in which five joints cannot place the sole, but leave it to the rest of
            the robot: 3 roll, 4 pitch, 5 yaw in the sole's axes; empty for six joints and more.
    """

    joints: tuple[int, ...]
    hip: int
    knee: int
    ankle: int
    bend: float
    length: float
    spare: tuple[int, ...] = ()
    unplaced: tuple[int, ...] = ()

    @property
    def placing(self) -> tuple[int, ...]:
        """The joints that place the sole: all but the spare ones."""
        return tuple(joint for joint in self.joints if joint not in self.spare)


def leg_joints(model: pin.Model, frame: int) -> list[int]:
    """Return the joints from the floating base (exclusive) to a frame, root first."""
    chain = [int(j) for j in model.supports[model.frames[frame].parentJoint]]
    return [j for j in chain if j > 1]


def find_leg(model: pin.Model, q: Array, joints: tuple[int, ...], sole: int, lateral: Array) -> Leg:
    """Return a leg by its joints: those about the `lateral` direction (3,) bend it.

    The leg's length is the longest distance from hip to sole: between the axes of hip, knee and
    ankle, seen along the knee's axis, and from the ankle to the sole plane.

    Args:
        model: the robot.
        q: any posture (nq,) in which the leg's side is `lateral`.
        joints: the leg's joints, pelvis first.
        sole: the sole frame.
        lateral: the direction (3,) to the left, in world axes.

    Raises:
        RobotError: fewer than three joints bend the leg.
    """
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    axes = _axes(model, q)
    turns = {j: float(axes[:, model.joints[j].idx_v] @ lateral) for j in joints}
    hip, knee, ankle, spare = _bending(model, data, turns)
    spare = spare[: max(0, len(joints) - 6)]
    axis = axes[:, model.joints[knee].idx_v]
    side = np.eye(3) - np.outer(axis, axis)
    points = [side @ data.oMi[j].translation for j in (hip, knee, ankle)]
    sole_pose = data.oMf[sole]
    drop = sole_pose.rotation[:, 2] @ (data.oMi[ankle].translation - sole_pose.translation)
    length = sum(float(np.linalg.norm(b - a)) for a, b in pairwise(points)) + float(drop)
    leg = Leg(joints, hip, knee, ankle, float(np.sign(turns[knee])), length, spare)
    return replace(leg, unplaced=_unplaced(model, q, leg, sole))


def _unplaced(model: pin.Model, q: Array, leg: Leg, sole: int) -> tuple[int, ...]:
    """Return the rotation of the sole that a leg of five joints, bent, places worst."""
    if len(leg.joints) > 5:
        return ()
    q = bent(model, q, leg, 1.0)
    jacobian = pin.computeFrameJacobian(
        model, model.createData(), q, sole, pin.ReferenceFrame.LOCAL
    )[:, [model.joints[joint].idx_v for joint in leg.joints]]
    jacobian[:3] /= leg.length

    def worst(row: int) -> float:
        return float(np.linalg.svd(np.delete(jacobian, row, axis=0), compute_uv=False)[-1])

    return (max((3, 4, 5), key=worst),)


def bent(model: pin.Model, q: Array, leg: Leg, forward: float) -> Array:
    """Return a configuration (nq,) with one leg bent, its knee forward (1) or backward (-1)."""
    q = np.array(q)
    lateral = np.sign(_axes(model, q)[1])
    for joint, angle in ((leg.hip, -0.4), (leg.knee, 0.8), (leg.ankle, -0.4)):
        bend = model.joints[joint]
        q[bend.idx_q] = forward * lateral[bend.idx_v] * angle
    return q


def _bending(
    model: pin.Model, data: pin.Data, turns: Mapping[int, float]
) -> tuple[int, int, int, tuple[int, ...]]:
    """Return hip, knee, ankle of a leg and what else bends it.

    Its joints turn by so much about the lateral axis.

    The ankle is the last joint about it, the hip the first, and the knee the one between that
    leaves thigh and shank longest. Hips whose axes are all tilted bend the leg by the least tilted.
    """
    bending = [j for j, turn in turns.items() if abs(turn) > LATERAL]
    chain = list(turns)
    if len(bending) == 2:
        before = chain[: chain.index(bending[0])]
        tilted = max(before, key=lambda j: abs(turns[j]), default=None)
        if tilted is not None and abs(turns[tilted]) > TILTED:
            bending.insert(0, tilted)
    if len(bending) < 3:
        names = ", ".join(model.names[j] for j in bending) or "none"
        raise RobotError(
            f"the leg from '{model.names[chain[0]]}' to '{model.names[chain[-1]]}' has "
            f"{len(bending)} joint(s) about the lateral axis ({names}); "
            "expected hip, knee and ankle"
        )
    at = {j: data.oMi[j].translation for j in bending}
    hip, *between, ankle = bending

    def shorter(joint: int) -> float:
        thigh, shank = at[joint] - at[hip], at[joint] - at[ankle]
        return min(float(np.linalg.norm(thigh)), float(np.linalg.norm(shank)))

    knee = max(between, key=shorter)
    return hip, knee, ankle, tuple(j for j in between if j != knee)


def _axes(model: pin.Model, q: Array) -> Array:
    """Return every degree of freedom's axis of rotation (3, nv) in the world, 0 for slides."""
    return np.array(pin.computeJointJacobians(model, model.createData(), q)[3:])


def knees_forward(model: pin.Model, legs: Mapping[Foot, Leg]) -> float:
    """Return 1 for knees that point forward when they bend, as ours, -1 for a bird's.

    Both knees together decide, by their limits; without limits they bend as ours.
    """
    room = 0.0
    for leg in legs.values():
        at = model.joints[leg.knee].idx_q
        low, high = model.lowerPositionLimit[at], model.upperPositionLimit[at]
        if np.isfinite(low) and np.isfinite(high):
            room += leg.bend * float(low + high)
    return 1.0 if room >= 0.0 else -1.0
