"""Build a robot from a model read and a description: find, adapt, check."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.building.agreement import check_agreement
from preview_walk.robots.building.assemble import assemble, sole_name
from preview_walk.robots.building.motors import joint_efforts
from preview_walk.robots.building.pinocchio_model import pinocchio_model
from preview_walk.robots.building.posture import Leg, find_leg, resting, walking_posture
from preview_walk.robots.building.rebuild import rebuild
from preview_walk.robots.building.statics import CROUCHED, straightened
from preview_walk.robots.finding.soles import SolePatch, find_sole, sole_axes
from preview_walk.robots.finding.structure import Structure, find_structure
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.description import Description
from preview_walk.robots.reading.mjcf import compile_spec, keyframe_angles, settle
from preview_walk.robots.reading.source import Source, foot_shapes
from preview_walk.robots.robot import Blueprint, Robot, RobotSole
from preview_walk.types import FEET, Array, Foot

CLEARANCE = 0.01
"""Least gap (m) between the soles in the walking posture."""

STRADDLE = 0.25
"""The soles stand as far apart as in the model's zero pose, unless that is this share of the leg's
length more or less than its hips: then they stand below the hips."""


def build_robot(description: Description, source: Source) -> Robot:
    """Return the robot that a description and its model stand for.

    Raises `RobotError` for a model that cannot walk, naming the body or joint that is in the way.
    """
    tree = source.tree
    given = {foot: fact.body for foot, fact in description.soles.items()}
    parts = find_structure(tree, given, description.torso)
    mass = float(tree.mj.body_subtreemass[parts.base])
    leg_joints = {joint for leg in parts.legs.values() for joint in leg}
    mimics = {} if source.urdf is None else source.urdf.mimics
    locked, settled = settle(tree, parts.base, leg_joints, mimics)
    efforts, pushed = joint_efforts(tree, source.urdf is not None, mass)
    for joint in sorted(leg_joints - {j for j, effort in efforts.items() if effort > 0.0}):
        raise RobotError(
            f"the leg joint '{tree.joint_name(joint)}' has no motor; "
            "expected one on every leg joint"
        )
    soles, seen = _soles(description, source, parts)
    spec, changed = rebuild(tree, parts.base, locked, looks=False)
    motors = {tree.joint_name(joint): effort for joint, effort in efforts.items()}
    assemble(spec, soles, motors)
    mj, _ = compile_spec(spec, "the robot")
    model = pinocchio_model(mj, root=1)
    frames = {foot: _sole_frame(mj, model, foot) for foot in FEET}
    check_agreement(mj, model, {foot: (sole_name(foot), frames[foot].frame) for foot in FEET})
    low, high = _limits(mj)
    set_limits(model, low, high)
    seen_at, key = ({}, "") if description.posture else keyframe_angles(tree)
    settled += [f"arms and trunk as in the keyframe '{key}'"] if key else []
    resting_at = (seen_at, description.posture)
    names = [str(name) for name in model.names[2:]]
    effort = np.array([motors.get(name, 0.0) for name in names])
    crouched, legs, width = _crouched(resting_at, parts, tree, mj, model, frames)
    sole_frames = {foot: frames[foot].frame for foot in FEET}
    posture = straightened(model, crouched, sole_frames, legs, width, effort)
    freed = _free_limits(mj, model, (crouched, posture))
    low, high = _limits(mj)
    data = model.createData()
    com = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    if posture is not crouched:
        stretch = data.oMi[legs["left"].hip].translation[2] / legs["left"].length
        settled.append(f"stands straight, at {stretch:.2f} of the leg's length: the knees are weak")
    left, right = (data.oMf[frames[f].frame].translation for f in FEET)
    freed_note = (
        [f"joint limits ignored, as they forbid to stand with bent knees: {', '.join(freed)}"]
        if freed
        else []
    )
    return Robot(
        name=description.name,
        title=description.title,
        source=description.model,
        mj=mj,
        pin=model,
        soles=frames,
        torso=_torso_frame(model, data, tree.name(parts.torso)),
        effort=effort,
        q_lower=low,
        q_upper=high,
        v_limit=np.array([source.speed.get(name, np.inf) for name in names]),
        damping=np.array(mj.dof_damping[6:]),
        posture=posture,
        mass=float(mj.body_mass.sum()),
        leg_length=min(leg.length for leg in legs.values()),
        step_width=float(np.linalg.norm((left - right)[:2])),
        com_height=float(com[2]),
        legs=legs,
        notes=(*source.notes, *parts.notes, *settled, *pushed, *seen, *changed, *freed_note),
        blueprint=Blueprint(
            tree, parts, frozenset(locked), tuple(freed), soles, motors, source.urdf
        ),
    )


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
        if fact is not None and fact.size is not None:
            length, width = fact.size
            soles[foot] = SolePatch(fact.body, np.array(fact.center), axes, length / 2, width / 2)
        else:
            tree, seen = foot_shapes(source, body)
            notes += seen
            soles[foot] = find_sole(tree, body, axes)
    return soles, notes


def _sole_frame(mj: mujoco.MjModel, model: pin.Model, foot: Foot) -> RobotSole:
    """Add a sole's frame to the Pinocchio model where MuJoCo has its site."""
    data = mujoco.MjData(mj)
    mujoco.mj_kinematics(mj, data)
    # Not from the site's own numbers: MuJoCo rounds a site onto the body's inertial axes where the
    # two differ by less than a millionth.
    site, geom = data.site(sole_name(foot)), mj.geom(sole_name(foot))
    body = data.body(int(mj.site(sole_name(foot)).bodyid[0]))
    here = pin.SE3(np.array(body.xmat).reshape(3, 3), np.array(body.xpos))
    there = pin.SE3(np.array(site.xmat).reshape(3, 3), np.array(site.xpos))
    frame = model.frames[model.getFrameId(body.name)]
    id_ = model.addFrame(
        pin.Frame(
            sole_name(foot),
            frame.parentJoint,
            0,
            frame.placement * here.actInv(there),
            pin.FrameType.OP_FRAME,
        )
    )
    return RobotSole(id_, geom.id, float(geom.size[0]), float(geom.size[1]))


def _torso_frame(model: pin.Model, data: pin.Data, torso: str) -> int:
    """Add the frame of the trunk, aligned with the world in the posture that `data` holds."""
    body = model.getFrameId(torso)
    joint = model.frames[body].parentJoint
    upright = pin.SE3(np.eye(3), data.oMf[body].translation)
    local = data.oMi[joint].actInv(upright)
    return int(model.addFrame(pin.Frame("upright_torso", joint, 0, local, pin.FrameType.OP_FRAME)))


def _limits(mj: mujoco.MjModel) -> tuple[Array, Array]:
    """Return the lower and upper joint limits (nv - 6,), infinite where there are none."""
    limited = mj.jnt_limited[1:].astype(bool)
    low = np.where(limited, mj.jnt_range[1:, 0], -np.inf)
    return low, np.where(limited, mj.jnt_range[1:, 1], np.inf)


def set_limits(model: pin.Model, low: Array, high: Array) -> None:
    """Give the Pinocchio model joint limits (nv - 6,); the base has none."""
    model.lowerPositionLimit = np.concatenate([np.full(7, -np.inf), low])
    model.upperPositionLimit = np.concatenate([np.full(7, np.inf), high])


def _crouched(
    resting_at: tuple[Mapping[str, float], Mapping[str, float]],
    parts: Structure,
    tree: Tree,
    mj: mujoco.MjModel,
    model: pin.Model,
    soles: dict[Foot, RobotSole],
) -> tuple[Array, dict[Foot, Leg], float]:
    """Return the most crouched walking posture (nq,), the legs, and the step width (m)."""
    rotation = tree.rotation(parts.base)
    forward, up = rotation.T @ parts.forward, rotation.T @ parts.up
    upright = np.vstack((forward, np.cross(up, forward), up))
    q = np.array(mj.qpos0)
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
    q = resting(model, q, *resting_at)
    sole_frames = {foot: soles[foot].frame for foot in FEET}
    return walking_posture(model, q, sole_frames, legs, width, CROUCHED), legs, width


def _free_limits(mj: mujoco.MjModel, model: pin.Model, postures: Iterable[Array]) -> list[str]:
    """Lift the limits that the postures break, in both models; return the joints' names."""
    low, high = _limits(mj)
    q = np.array([posture[7:] for posture in postures])
    broken = np.flatnonzero(((q < low) | (q > high)).any(axis=0)).tolist()
    for joint in broken:
        mj.jnt_limited[1 + joint] = 0
        low[joint], high[joint] = -np.inf, np.inf
    set_limits(model, low, high)
    return [str(model.names[2 + joint]) for joint in broken]
