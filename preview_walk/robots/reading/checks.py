"""The one check of the numbers in a model read: what no robot has is a slip, and is told."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.bounds import LARGEST, LARGEST_GAIN, LARGEST_MASS, SMALLEST_EFFORT
from preview_walk.robots.finding.tree import Tree
from preview_walk.types import Array

_PLACE, _UNIT = ("m", -LARGEST, LARGEST), ("", -1.01, 1.01)
_GAIN = (0.0, LARGEST_GAIN)
_BODIES = (
    ("body_mass", "the mass", "kg", 0.0, LARGEST_MASS),
    ("body_inertia", "the moment of inertia", "kg·m²", *_GAIN),
    ("body_pos", "the position", *_PLACE),
    ("body_ipos", "the centre of mass", *_PLACE),
    ("body_quat", "the quaternion", *_UNIT),
    ("body_iquat", "the quaternion of inertia", *_UNIT),
)
_JOINTS = (("jnt_pos", "the anchor", *_PLACE), ("jnt_axis", "the axis", *_UNIT))
_DOFS = (
    ("dof_damping", "the damping", "N·m·s/rad", *_GAIN),
    ("dof_frictionloss", "the dry friction", "N·m", *_GAIN),
    ("dof_armature", "the armature", "kg·m²", *_GAIN),
)
_GEOMS = (
    ("geom_size", "a shape of the size", "m", 0.0, LARGEST),
    ("geom_pos", "a shape at", *_PLACE),
    ("geom_quat", "a shape of the quaternion", *_UNIT),
)
_ACTUATORS = ("actuator_gear", "actuator_ctrlrange", "actuator_forcerange", "actuator_gainprm")
_NO_SIZE = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))


def check_numbers(tree: Tree, speed: Mapping[str, float]) -> None:
    """Check the masses, places, limits and sizes of a model.

    Args:
        tree: the model.
        speed: speed limits (rad/s) by joint name.

    Raises:
        RobotError: a number that is none, or that no robot has; names the body or joint.
    """
    mj = tree.mj
    for field, *bound in _BODIES:
        _check("body", tree.name, getattr(mj, field), bound)
    for field, *bound in _JOINTS:
        _check("joint", tree.joint_name, getattr(mj, field), bound)
    for field, *bound in _DOFS:
        _check("joint", tree.joint_name, getattr(mj, field)[mj.jnt_dofadr], bound)
    zero = ("the reference", "rad or m", -LARGEST, LARGEST)
    _check("joint", tree.joint_name, mj.qpos0[mj.jnt_qposadr], zero)
    limits = np.where(mj.jnt_limited[:, None], mj.jnt_range, 0.0)
    _check("joint", tree.joint_name, limits, ("the limit", "rad or m", -LARGEST_GAIN, LARGEST_GAIN))
    _check_efforts(tree)
    for joint, value in speed.items():
        _within("joint", joint, value, ("the speed limit", "rad/s", SMALLEST_EFFORT, np.inf))
    solid = (mj.body_weldid[mj.geom_bodyid] != 0) & ~np.isin(mj.geom_type, _NO_SIZE)
    owners = mj.geom_bodyid[solid].tolist()
    for field, *bound in _GEOMS:
        _check("body", lambda geom: tree.name(owners[geom]), getattr(mj, field)[solid], bound)
    for field in _ACTUATORS:
        bound = [f"in {field.removeprefix('actuator_')}", "", -np.inf, np.inf]
        _check("actuator", lambda i: str(mj.actuator(i).name), getattr(mj, field), bound)
    key = ("an angle of", "rad or m", -LARGEST, LARGEST)
    _check("keyframe", lambda i: str(mj.key(i).name), mj.key_qpos, key)


def _check_efforts(tree: Tree) -> None:
    """Check the joints' own torque limits; the motors' are checked where they are found."""
    mj = tree.mj
    for joint in np.flatnonzero(mj.jnt_actfrclimited).tolist():
        high = float(mj.jnt_actfrcrange[joint, 1])
        bound = ("the torque limit", "N·m", SMALLEST_EFFORT, np.inf)
        if mj.jnt_actfrcrange[joint].any():  # a joint without any torque is a passive one
            _within("joint", tree.joint_name(joint), high, bound)


def _check(
    kind: str,
    name: Callable[[int], str],
    values: Array,
    bound: Sequence[Any],
) -> None:
    """Raise `RobotError` for the first row of values (n,) or (n, k) that breaks a bound.

    A bound holds what the number is, its unit, and the least and largest that it may be.
    """
    _, _, low, high = bound
    rows = np.asarray(values).reshape(len(values), -1) if len(values) else np.empty((0, 1))
    bad = np.argwhere(~((rows >= low) & (rows <= high)))
    if len(bad):
        row, column = bad[0].tolist()
        _within(kind, name(row), float(rows[row, column]), bound)


def _within(kind: str, name: str, value: float, bound: Sequence[Any]) -> None:
    """Raise `RobotError` unless a value lies between two bounds; NaN does not."""
    what, unit, low, high = bound
    if not low <= value <= high:
        room = f"{low:g} to {high:g}" if np.isfinite(high) else f"at least {low:g}"
        room = room if np.isfinite(low) else "a number"
        raise RobotError(
            f"the {kind} '{name}' has {what} {value:g}{f' {unit}' if unit else ''}; expected {room}"
        )
