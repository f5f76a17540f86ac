"""Build a robot from a model read and a description: find, adapt, check."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.building.engines import in_two_engines, joint_limits, torso_frame
from preview_walk.robots.building.motors import joint_efforts, with_driven_legs
from preview_walk.robots.building.stand import stand
from preview_walk.robots.finding.constraints import settle
from preview_walk.robots.finding.overlaps import overlaps
from preview_walk.robots.finding.soles import SolePatch, find_sole, rocks, sole_axes
from preview_walk.robots.finding.structure import Structure, find_structure
from preview_walk.robots.reading.facts import Description, MotorLimit
from preview_walk.robots.reading.source import Source, foot_shapes
from preview_walk.robots.robot import Blueprint, Robot
from preview_walk.types import FEET, Foot


def build_robot(description: Description, source: Source) -> Robot:
    """Return the robot that a description and its model stand for.

    Args:
        description: what its model does not say.
        source: the model.

    Raises:
        RobotError: a model that cannot walk; names the body or joint that is in the way.
    """
    tree = source.tree
    given = {foot: fact.body for foot, fact in description.soles.items()}
    parts = find_structure(tree, given, description.torso)
    efforts, pushed = _efforts(source, parts.base, description.limits)
    parts, passive = with_driven_legs(tree, parts, efforts)
    leg_joints = {joint for leg in parts.legs.values() for joint in leg}
    mimics = {} if source.urdf is None else source.urdf.mimics
    driven, settled = settle(tree, parts.base, leg_joints, mimics)
    locked = driven | passive
    motors = {tree.joint_name(joint): effort for joint, effort in efforts.items()}
    soles, seen = _soles(description, source, parts)
    engines, changed = in_two_engines(tree, parts.base, locked, soles, motors)
    mj, model = engines.mj, engines.pin
    names = [str(name) for name in model.names[2:]]
    effort = np.array([motors.get(name, 0.0) for name in names])
    posture, legs, freed, stood = stand(engines, tree, parts, description.posture, effort)
    meeting = overlaps(tree, parts.base, dict(zip(names, posture[7:], strict=True)))
    if meeting:
        stood.append(f"shapes that can touch overlap in the walking posture: {', '.join(meeting)}")
    low, high = joint_limits(mj)
    data = model.createData()
    com = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    left, right = (data.oMf[engines.soles[f].frame].translation for f in FEET)
    said = {name: limit.speed for name, limit in description.limits.items() if limit.speed}
    speed = {**source.speed, **said}
    file = None if source.urdf is None else source.urdf.file
    return Robot(
        name=description.name,
        title=description.title,
        source=description.model,
        mj=mj,
        pin=model,
        soles=engines.soles,
        torso=torso_frame(model, data, tree.name(parts.torso)),
        effort=effort,
        q_lower=low,
        q_upper=high,
        v_limit=np.array([speed.get(name, np.inf) for name in names]),
        damping=np.array(mj.dof_damping[6:]),
        posture=posture,
        mass=float(mj.body_mass.sum()),
        leg_length=min(leg.length for leg in legs.values()),
        step_width=float(np.linalg.norm((left - right)[:2])),
        com_height=float(com[2]),
        legs=legs,
        notes=(*source.notes, *parts.notes, *settled, *pushed, *seen, *changed, *stood),
        blueprint=Blueprint(tree, parts, frozenset(locked), freed, soles, motors, file),
    )


def _efforts(
    source: Source, base: int, limits: Mapping[str, MotorLimit]
) -> tuple[Mapping[int, float], list[str]]:
    """Return the torque limits (N·m) of the motors by joint, as read or as said, and remarks."""
    tree = source.tree
    own = {tree.joint_name(joint): joint for joint in tree.joints_on(tree.below(base))}
    for name in limits:
        if name not in own:
            raise RobotError(
                f"the limits name the joint '{name}', which the model lacks; "
                f"it has {', '.join(own)}"
            )
    said = {own[name]: limit.torque for name, limit in limits.items() if limit.torque}
    return joint_efforts(tree, base, source.urdf is not None, said)


def _soles(
    description: Description, source: Source, parts: Structure
) -> tuple[dict[Foot, SolePatch], list[str]]:
    """Return the soles: as described, else as found from the feet's shapes; and remarks."""
    soles: dict[Foot, SolePatch] = {}
    notes: list[str] = []
    for foot in FEET:
        body = parts.feet[foot]
        axes = sole_axes(source.tree, body, parts.up, parts.forward)
        fact = description.soles.get(foot)
        if fact is not None and fact.rpy is not None:
            axes = pin.rpy.rpyToMatrix(np.array(fact.rpy))
        if fact is not None and fact.size is not None:
            soles[foot] = SolePatch(fact.body, np.array(fact.center), axes, fact.size)
        else:
            tree, seen = foot_shapes(source, body)
            notes += seen
            soles[foot] = find_sole(tree, body, axes)
            below = rocks(tree, body, soles[foot])
            if below > 0.0:
                notes.append(
                    f"a shape of '{soles[foot].body}' reaches {1e3 * below:.1f} mm below the flat "
                    "of its sole: in its own scene the foot rocks on it"
                )
    return soles, notes
