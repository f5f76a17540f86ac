"""Build the Pinocchio model of a robot from its compiled MuJoCo model.

Two parsers reading one file disagree sooner or later (dropped joints, keyframes, fused links,
armature), so Pinocchio never reads a file here: both engines come from one `MjModel`, with the
velocities in the same order.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.types import Array

_HINGE, _SLIDE, _FREE = (
    int(mujoco.mjtJoint.mjJNT_HINGE),
    int(mujoco.mjtJoint.mjJNT_SLIDE),
    int(mujoco.mjtJoint.mjJNT_FREE),
)


def placement(position: Array, quaternion_wxyz: Array) -> pin.SE3:
    """Return the SE3 of a MuJoCo position (3,), m, and unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion_wxyz
    return pin.SE3(pin.Quaternion(w, x, y, z).normalized().toRotationMatrix(), np.array(position))


def pinocchio_model(mj: mujoco.MjModel, root: int) -> pin.Model:
    """Return the Pinocchio model of the kinematic tree below body `root` of a MuJoCo model.

    The root joint is a free flyer; every further joint is a hinge or a slide, in MuJoCo's order,
    so that joint velocities and torques need no permutation. Bodies become frames of their name.
    Armature is copied; joint damping and dry friction are not part of Pinocchio's dynamics.

    Args:
        mj: MuJoCo's model.
        root: the body on the free joint.

    Raises:
        RobotError: a joint that has no Pinocchio equivalent.
    """
    model = pin.Model()
    model.name = "robot"
    model.gravity.linear = np.array(mj.opt.gravity)
    body_joint: dict[int, int] = {}
    body_offset: dict[int, pin.SE3] = {}
    for body in range(1, mj.nbody):
        if body != root and mj.body_parentid[body] not in body_joint:
            continue
        name = mj.body(body).name or f"body_{body}"
        if body == root:
            parent, offset = 0, pin.SE3.Identity()
        else:
            up = int(mj.body_parentid[body])
            parent = body_joint[up]
            offset = body_offset[up] * placement(mj.body_pos[body], mj.body_quat[body])
        first = int(mj.body_jntadr[body])
        for joint in range(first, first + int(mj.body_jntnum[body])):
            parent, offset = _add_joint(model, mj, joint, parent, offset)
        body_joint[body], body_offset[body] = parent, offset
        inertia_frame = placement(mj.body_ipos[body], mj.body_iquat[body])
        inertia = pin.Inertia(
            float(mj.body_mass[body]), np.zeros(3), np.diag(mj.body_inertia[body])
        )
        model.appendBodyToJoint(parent, inertia, offset * inertia_frame)
        model.addFrame(pin.Frame(name, parent, 0, offset, pin.FrameType.BODY))
    return model


def _add_joint(
    model: pin.Model, mj: mujoco.MjModel, joint: int, parent: int, offset: pin.SE3
) -> tuple[int, pin.SE3]:
    """Add one MuJoCo joint; return the new joint and the body's placement in it."""
    kind = int(mj.jnt_type[joint])
    name = mj.joint(joint).name or f"joint_{joint}"
    dof = int(mj.jnt_dofadr[joint])
    if kind == _FREE:
        added = model.addJoint(parent, pin.JointModelFreeFlyer(), pin.SE3.Identity(), name)
        local = pin.SE3.Identity()
    elif kind in (_HINGE, _SLIDE):
        axis = np.array(mj.jnt_axis[joint])
        anchor = pin.SE3(np.eye(3), np.array(mj.jnt_pos[joint]))
        # MuJoCo measures a joint from qpos0, Pinocchio from zero: fold the difference in.
        zero = -float(mj.qpos0[mj.jnt_qposadr[joint]])
        if kind == _HINGE:
            shift = pin.SE3(pin.AngleAxis(zero, axis).toRotationMatrix(), np.zeros(3))
            added = model.addJoint(
                parent, pin.JointModelRevoluteUnaligned(axis), offset * anchor * shift, name
            )
        else:
            shift = pin.SE3(np.eye(3), zero * axis)
            added = model.addJoint(
                parent, pin.JointModelPrismaticUnaligned(axis), offset * anchor * shift, name
            )
        local = anchor.inverse()
    else:
        raise RobotError(
            f"joint '{name}' is a ball joint, which has no equivalent here; "
            "free (base only), hinge and slide joints are allowed"
        )
    armature = np.array(model.armature)
    span = model.joints[added].nv
    armature[model.joints[added].idx_v :][:span] = mj.dof_armature[dof : dof + span]
    model.armature = armature
    return added, local
