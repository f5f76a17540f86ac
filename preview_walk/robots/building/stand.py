"""Stand a robot up: its legs found, their joints bent, the limits that forbid it lifted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pinocchio as pin

from preview_walk.robots.building.engines import Engines, joint_limits, set_limits
from preview_walk.robots.building.leg import Leg, find_leg
from preview_walk.robots.building.posture import Stance, resting, walking_posture
from preview_walk.robots.building.statics import CROUCHED, straightened
from preview_walk.robots.finding.structure import Structure
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.mjcf import keyframe_angles
from preview_walk.types import FEET, Array, Foot

CLEARANCE = 0.01
"""Least gap (m) between the soles in the walking posture."""

STRADDLE = 0.25
"""The soles stand as far apart as in the model's zero pose, unless that is this share of the leg's
length more or less than its hips: then they stand below the hips."""


def stand(
    engines: Engines,
    tree: Tree,
    parts: Structure,
    named: Mapping[str, float],
    effort: Array,
) -> tuple[Array, Mapping[Foot, Leg], tuple[str, ...], list[str]]:
    """Return the walking posture (nq,), the legs, the joints freed of their limits, and remarks.

    Limits that the posture breaks are lifted in both engines.

    Args:
        engines: the robot.
        tree: the source model, whose keyframes may say how arms and trunk are held.
        parts: what stands for what in it.
        named: joint angles (rad) that are asked for, by name.
        effort: torque limits (n,), N·m.

    Raises:
        RobotError: there is no walking posture, or the asked for angles cannot be.
    """
    model = engines.pin
    seen, key = ({}, "") if named else keyframe_angles(tree)
    notes = [f"arms and trunk as in the keyframe '{key}'"] if key else []
    q, stance = _stance(engines, tree, parts)
    crouched = walking_posture(stance, resting(model, q, seen, named), CROUCHED)
    posture = straightened(stance, crouched, effort)
    if posture is not crouched:
        data, leg = model.createData(), stance.legs["left"]
        pin.forwardKinematics(model, data, posture)
        stretch = data.oMi[leg.hip].translation[2] / leg.length
        notes.append(f"stands straight, at {stretch:.2f} of the leg's length: the knees are weak")
    freed = _free_limits(engines, (crouched, posture))
    if freed:
        names = ", ".join(freed)
        notes.append(f"joint limits ignored, as they forbid to stand with bent knees: {names}")
    return posture, stance.legs, freed, notes


def _stance(engines: Engines, tree: Tree, parts: Structure) -> tuple[Array, Stance]:
    """Return the upright reference configuration (nq,), and what the robot stands on."""
    model, soles = engines.pin, engines.soles
    rotation = tree.rotation(parts.base)
    forward, up = rotation.T @ parts.forward, rotation.T @ parts.up
    upright = np.vstack((forward, np.cross(up, forward), up))
    q = np.array(engines.mj.qpos0)
    q[:3], q[3:7] = 0.0, pin.Quaternion(upright).coeffs()
    legs: dict[Foot, Leg] = {
        foot: find_leg(
            model,
            q,
            tuple(model.getJointId(tree.joint_name(joint)) for joint in parts.legs[foot]),
            soles[foot].frame,
            np.array((0.0, 1.0, 0.0)),
        )
        for foot in FEET
    }
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    left, right = (data.oMf[soles[foot].frame].translation for foot in FEET)
    hips = data.oMi[legs["left"].hip].translation - data.oMi[legs["right"].hip].translation
    straddled = abs(left - right - hips)[1] > STRADDLE * legs["left"].length
    width = float(hips[1] if straddled else (left - right)[1])
    width = max(width, soles["left"].half_width + soles["right"].half_width + CLEARANCE)
    return q, Stance(model, {foot: soles[foot].frame for foot in FEET}, legs, width)


def _free_limits(engines: Engines, postures: Iterable[Array]) -> tuple[str, ...]:
    """Lift the limits that the postures break, in both models; return the joints' names."""
    mj, model = engines.mj, engines.pin
    low, high = joint_limits(mj)
    q = np.array([posture[7:] for posture in postures])
    broken = np.flatnonzero(((q < low) | (q > high)).any(axis=0)).tolist()
    for joint in broken:
        mj.jnt_limited[1 + joint] = 0
        low[joint], high[joint] = -np.inf, np.inf
    set_limits(model, low, high)
    return tuple(str(model.names[2 + joint]) for joint in broken)
