"""Torque limits of joints: what the model's actuators, of whatever kind, can push with."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import mujoco
import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.bounds import LARGEST_GAIN, SMALLEST_EFFORT
from preview_walk.robots.finding.legs import LEG_JOINTS
from preview_walk.robots.finding.structure import Structure
from preview_walk.robots.finding.tree import Tree

ASSUMED = 3.0
"""Torque (N·m, or N for a slide) per kg of robot assumed for a motor without a limit."""

_JOINT = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))


def joint_efforts(
    tree: Tree, base: int, implied: bool, said: Mapping[int, float]
) -> tuple[dict[int, float], list[str]]:
    """Return the largest torque (N·m) of every joint with a motor, by joint id, and remarks.

    A motor without a force limit gets `ASSUMED` times the robot's mass.

    Args:
        tree: the model.
        base: its floating body; joints that it does not carry are somebody else's.
        implied: whether every joint has a motor even without an actuator, as in a URDF.
        said: torque limits (N·m) by joint id that take the place of the model's.

    Raises:
        RobotError: the model has no motors at all.
    """
    mj, mass = tree.mj, float(tree.mj.body_subtreemass[base])
    moving = tree.joints_on(tree.below(base))
    push, replaced = _actuated(mj, moving)
    if mj.nu == 0:
        push = {j: (-np.inf, np.inf) for j in moving if implied or mj.jnt_actfrclimited[j]}
    push.update({joint: (-effort, effort) for joint, effort in said.items()})
    if not push:
        raise RobotError(
            "the model has no motors: expected an actuator, or an effort limit, for every joint"
        )
    efforts, assumed = {}, []
    for joint, (low, high) in push.items():
        if mj.jnt_actfrclimited[joint] and joint not in said:
            low = max(low, float(mj.jnt_actfrcrange[joint, 0]))
            high = min(high, float(mj.jnt_actfrcrange[joint, 1]))
        effort = min(-low, high)
        if not effort <= LARGEST_GAIN:  # as good as none
            effort = ASSUMED * mass
            assumed.append(tree.joint_name(joint))
        if effort != 0.0 and not effort >= SMALLEST_EFFORT:
            raise RobotError(
                f"the motor of the joint '{tree.joint_name(joint)}' gives {effort:g} N·m; "
                f"expected 0 or at least {SMALLEST_EFFORT:g}"
            )
        efforts[joint] = effort
    notes = []
    if replaced:
        notes.append(f"{replaced} position, velocity or other actuators became torque motors")
    if assumed:
        notes.append(
            f"no torque limit: {ASSUMED * mass:.0f} N·m ({ASSUMED:g} N·m per kg) assumed for "
            + ", ".join(assumed)
        )
    return efforts, notes


def _actuated(
    mj: mujoco.MjModel, moving: Collection[int]
) -> tuple[dict[int, tuple[float, float]], int]:
    """Return the lowest and highest torque (N·m) of the joints that actuators drive, by joint id.

    And how many of these actuators were no torque motors. `moving`: the joints that count.
    """
    push: dict[int, tuple[float, float]] = {}
    replaced = 0
    for actuator in range(mj.nu):
        joint = int(mj.actuator_trnid[actuator, 0])
        if int(mj.actuator_trntype[actuator]) not in _JOINT or joint not in moving:
            continue
        low, high, torque = _range(mj, actuator)
        replaced += not torque
        before = push.get(joint, (0.0, 0.0))
        push[joint] = (before[0] + low, before[1] + high)
    return push, replaced


def with_driven_legs(
    tree: Tree, parts: Structure, efforts: Mapping[int, float]
) -> tuple[Structure, set[int]]:
    """Return a robot's parts with the legs' driven joints alone, and the passive ones (ids).

    A joint that has no motor in either leg, as a spring in an ankle, is passive: it stays where it
    is, and the other joints of the leg must do.

    Args:
        tree: the model.
        parts: its parts.
        efforts: torque limits (N·m) by joint id.

    Raises:
        RobotError: a leg joint that has no motor while that of the other leg has, or without which
            the leg cannot do.
    """
    driven = {
        foot: tuple(joint for joint in leg if efforts.get(joint, 0.0) > 0.0)
        for foot, leg in parts.legs.items()
    }
    lacking = {
        foot: tuple(place for place, joint in enumerate(leg) if joint not in driven[foot])
        for foot, leg in parts.legs.items()
    }
    passive = {joint for foot, leg in parts.legs.items() for joint in leg} - {
        joint for leg in driven.values() for joint in leg
    }
    alike = lacking["left"] == lacking["right"]
    if passive and not (alike and min(map(len, driven.values())) >= LEG_JOINTS):
        raise RobotError(
            f"the leg joint '{tree.joint_name(min(passive))}' has no motor; "
            "expected one on every leg joint"
        )
    if not passive:
        return parts, passive
    names = ", ".join(tree.joint_name(joint) for joint in sorted(passive))
    note = f"locked, because no motor moves them: {names}"
    return replace(parts, legs=driven, notes=(*parts.notes, note)), passive


def _range(mj: mujoco.MjModel, actuator: int) -> tuple[float, float, bool]:
    """Return the least and largest joint torque of an actuator, and whether it is a plain motor."""
    gear = float(mj.actuator_gear[actuator, 0])
    motor = (
        int(mj.actuator_gaintype[actuator]) == int(mujoco.mjtGain.mjGAIN_FIXED)
        and int(mj.actuator_biastype[actuator]) == int(mujoco.mjtBias.mjBIAS_NONE)
        and int(mj.actuator_dyntype[actuator]) == int(mujoco.mjtDyn.mjDYN_NONE)
    )
    low, high = -np.inf, np.inf
    if motor and mj.actuator_ctrllimited[actuator]:
        gain = float(mj.actuator_gainprm[actuator, 0])
        low, high = sorted(gain * mj.actuator_ctrlrange[actuator])
    if mj.actuator_forcelimited[actuator]:
        low = max(low, float(mj.actuator_forcerange[actuator, 0]))
        high = min(high, float(mj.actuator_forcerange[actuator, 1]))
    low, high = sorted((gear * low, gear * high)) if gear else (0.0, 0.0)
    return low, high, motor
