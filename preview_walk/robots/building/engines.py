"""One robot in two engines: MuJoCo's model, Pinocchio's from the same numbers, and the soles."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.geometry.support import Sole
from preview_walk.robots.building.agreement import check_agreement
from preview_walk.robots.building.assemble import assemble, sole_name
from preview_walk.robots.building.pinocchio_model import pinocchio_model
from preview_walk.robots.building.rebuild import rebuild
from preview_walk.robots.finding.soles import SolePatch
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.mjcf import compile_spec
from preview_walk.robots.robot import RobotSole
from preview_walk.types import FEET, Array, Foot


@dataclass(frozen=True, eq=False)
class Engines:
    """A robot in two engines.

    Attributes:
        mj: MuJoCo's model.
        pin: Pinocchio's, with the joint limits of MuJoCo's.
        soles: the soles in both.
    """

    mj: mujoco.MjModel
    pin: pin.Model
    soles: Mapping[Foot, RobotSole]


def in_two_engines(
    tree: Tree,
    base: int,
    locked: Collection[int],
    soles: Mapping[Foot, SolePatch],
    motors: Mapping[str, float],
) -> tuple[Engines, list[str]]:
    """Return a robot in two engines that agree, and remarks.

    Args:
        tree: the source model.
        base: its floating body.
        locked: joints (ids) that stay in their reference pose.
        soles: where the soles are.
        motors: torque limits (N·m) by joint name.

    Raises:
        RobotError: masses that cannot be, or engines that disagree.
    """
    spec, notes = rebuild(tree, base, locked, looks=False)
    assemble(spec, soles, motors)
    mj, _ = compile_spec(spec, "the robot")
    model = pinocchio_model(mj, root=1)
    frames = {foot: _sole_frame(mj, model, foot) for foot in FEET}
    check_agreement(mj, model, {foot: (sole_name(foot), frames[foot].frame) for foot in FEET})
    set_limits(model, *joint_limits(mj))
    return Engines(mj, model, frames), notes


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
    return RobotSole(id_, geom.id, Sole(float(geom.size[0]), float(geom.size[1])))


def torso_frame(model: pin.Model, data: pin.Data, torso: str) -> int:
    """Add the frame of the trunk, aligned with the world in the posture that `data` holds."""
    body = model.getFrameId(torso)
    joint = model.frames[body].parentJoint
    upright = pin.SE3(np.eye(3), data.oMf[body].translation)
    local = data.oMi[joint].actInv(upright)
    return int(model.addFrame(pin.Frame("upright_torso", joint, 0, local, pin.FrameType.OP_FRAME)))


def joint_limits(mj: mujoco.MjModel) -> tuple[Array, Array]:
    """Return the lower and upper joint limits (nv - 6,), infinite where there are none."""
    limited = mj.jnt_limited[1:].astype(bool)
    low = np.where(limited, mj.jnt_range[1:, 0], -np.inf)
    return low, np.where(limited, mj.jnt_range[1:, 1], np.inf)


def set_limits(model: pin.Model, low: Array, high: Array) -> None:
    """Give the Pinocchio model joint limits (nv - 6,); the base has none."""
    model.lowerPositionLimit = np.concatenate([np.full(7, -np.inf), low])
    model.upperPositionLimit = np.concatenate([np.full(7, np.inf), high])
