"""`load_robot`: from a name or a file to a robot ready to walk."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.assemble import assemble, sole_name
from preview_walk.robots.description import Description, model_path, read_description
from preview_walk.robots.pinocchio_model import pinocchio_model, placement
from preview_walk.robots.posture import leg_length, walking_posture
from preview_walk.robots.robot import Robot, RobotSole
from preview_walk.robots.urdf import urdf_spec
from preview_walk.types import FEET, Array, Foot


def load_robot(name: str) -> Robot:
    """Return the robot of a catalogue name.

    Raises `RobotError` for an unknown name or a model that cannot walk.
    """
    return build(read_description(name))


def visual_model(robot: Robot) -> mujoco.MjModel:
    """Return the robot's MuJoCo model with its visual meshes: same bodies, joints and state."""
    description = read_description(robot.name)
    spec = urdf_spec(model_path(description.model), visuals=True)
    assemble(spec, description.soles)
    return spec.compile()


def build(description: Description) -> Robot:
    """Return the robot that a description stands for."""
    path = model_path(description.model)
    spec = urdf_spec(path)
    assemble(spec, description.soles)
    mj = spec.compile()
    model = pinocchio_model(mj, root=1)
    soles: dict[Foot, RobotSole] = {}
    for foot in FEET:
        body = mj.body(description.soles[foot].body).id
        site = mj.site(sole_name(foot))
        frame = model.frames[model.getFrameId(mj.body(body).name)]
        local = frame.placement * placement(site.pos, site.quat)
        id_ = model.addFrame(
            pin.Frame(sole_name(foot), frame.parentJoint, 0, local, pin.FrameType.OP_FRAME)
        )
        half = mj.geom(sole_name(foot)).size
        soles[foot] = RobotSole(id_, mj.geom(sole_name(foot)).id, float(half[0]), float(half[1]))
    torso = model.getFrameId(description.torso)
    if torso >= model.nframes:
        raise RobotError(f"the torso frame '{description.torso}' is not in the model")
    effort = _effort(mj)
    limited = mj.jnt_limited[1:].astype(bool)
    low = np.where(limited, mj.jnt_range[1:, 0], -np.inf)
    high = np.where(limited, mj.jnt_range[1:, 1], np.inf)
    model.lowerPositionLimit = np.concatenate([np.full(7, -np.inf), low])
    model.upperPositionLimit = np.concatenate([np.full(7, np.inf), high])
    posture = walking_posture(
        model, {f: soles[f].frame for f in FEET}, torso, description.posture
    )
    data = model.createData()
    com = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    left, right = (data.oMf[soles[f].frame].translation for f in FEET)
    return Robot(
        name=description.name,
        title=description.title,
        source=str(description.model),
        mj=mj,
        pin=model,
        soles=soles,
        torso=torso,
        effort=effort,
        q_lower=low,
        q_upper=high,
        v_limit=_speed_limits(path, model),
        damping=np.array(mj.dof_damping[6:]),
        posture=posture,
        mass=float(mj.body_mass.sum()),
        leg_length=leg_length(model, soles["left"].frame),
        step_width=float(np.linalg.norm((left - right)[:2])),
        com_height=float(com[2]),
    )


def _effort(mj: mujoco.MjModel) -> Array:
    """Return the largest torque of every joint (nv - 6,) in N·m, 0 without a motor."""
    effort = np.zeros(mj.nv - 6)
    for motor in range(mj.nu):
        joint = mj.actuator_trnid[motor, 0]
        effort[mj.jnt_dofadr[joint] - 6] = mj.actuator_ctrlrange[motor, 1]
    return effort


def _speed_limits(path: Path, model: pin.Model) -> Array:
    """Return the joint speed limits (nv - 6,) of a URDF; MuJoCo does not keep them."""
    limits = {}
    for joint in ElementTree.parse(path).getroot().findall("joint"):
        limit = joint.find("limit")
        if limit is not None and float(limit.get("velocity", "0")) > 0:
            limits[joint.get("name")] = float(limit.get("velocity", "0"))
    return np.array([limits.get(name, np.inf) for name in model.names[2:]])
