"""Rebuild a robot from its compiled model: bodies, joints and looks, nothing else.

Whatever a file holds besides (keyframes, sensors, tendons, contacts, defaults, cameras, other
bodies of the scene) stays behind, and every robot reaches the controller in the same form.
"""

from __future__ import annotations

from collections.abc import Collection

import mujoco
import numpy as np

from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.inertia import usable_inertia
from preview_walk.robots.reading.shapes import finish
from preview_walk.robots.reading.urdf import quaternion
from preview_walk.types import Array

SHOWN = 3
"""MuJoCo geom groups below this one are shown; the others hold collision shapes."""


def rebuild(
    tree: Tree, base: int, locked: Collection[int], looks: bool
) -> tuple[mujoco.MjSpec, list[str]]:
    """Return a spec of the robot below the body `base`, on a free joint, and remarks.

    Joint springs are left out.

    Args:
        tree: the source model.
        base: the robot's floating body in it.
        locked: joints (ids) that stay in their reference pose.
        looks: whether the shown geoms come along, in their colours, touching nothing.

    Raises:
        RobotError: masses that cannot be.
    """
    mj = tree.mj
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    bodies: dict[int, mujoco.MjsBody] = {}
    flaws: dict[str, list[str]] = {}
    springs: list[str] = []
    for body in tree.below(base):
        if body == base:
            made = spec.worldbody.add_body(name=tree.name(body))
            made.add_freejoint(name="root")
        else:
            made = bodies[int(mj.body_parentid[body])].add_body(
                name=tree.name(body), pos=mj.body_pos[body], quat=mj.body_quat[body]
            )
        bodies[body] = made
        joints = [] if body == base else [j for j in tree.joints_on([body]) if j not in locked]
        flaw = _set_inertia(tree, made, body, bool(joints))
        if flaw:
            flaws.setdefault(flaw, []).append(tree.name(body))
        for joint in joints:
            _add_joint(tree, made, joint)
            if mj.jnt_stiffness[joint] > 0.0:
                springs.append(tree.joint_name(joint))
        if looks:
            _add_looks(mj, spec, made, body)
    notes = [f"{flaw}: {', '.join(names)}" for flaw, names in flaws.items()]
    if springs:
        notes.append(f"joint springs left out: {', '.join(springs)}")
    return spec, notes


def _set_inertia(tree: Tree, made: mujoco.MjsBody, body: int, moving: bool) -> str:
    """Copy the inertia of a body (id), made usable; return what was wrong with it, or "".

    `moving`: whether the body hangs on a joint of its own.
    """
    mj = tree.mj
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, mj.body_iquat[body])
    axes = rotation.reshape(3, 3)
    inertia = axes @ np.diag(mj.body_inertia[body]) @ axes.T
    name, mass = tree.name(body), float(mj.body_mass[body])
    mass, moments, turn, flaw = usable_inertia(name, mass, inertia, moving)
    made.explicitinertial = True
    made.mass, made.ipos, made.inertia = mass, mj.body_ipos[body], moments
    made.iquat = quaternion(turn)
    return flaw


def _add_joint(tree: Tree, body: mujoco.MjsBody, joint: int) -> None:
    """Copy a hinge or a slide."""
    mj = tree.mj
    dof = int(mj.jnt_dofadr[joint])
    made = body.add_joint(
        name=tree.joint_name(joint),
        type=mujoco.mjtJoint(int(mj.jnt_type[joint])),
        pos=mj.jnt_pos[joint],
        axis=mj.jnt_axis[joint],
        ref=float(mj.qpos0[mj.jnt_qposadr[joint]]),
    )
    made.limited, made.range = bool(mj.jnt_limited[joint]), mj.jnt_range[joint]
    made.damping = (float(mj.dof_damping[dof]), 0.0, 0.0)
    made.armature = float(mj.dof_armature[dof])
    made.frictionloss = float(mj.dof_frictionloss[dof])


def _add_looks(mj: mujoco.MjModel, spec: mujoco.MjSpec, made: mujoco.MjsBody, body: int) -> None:
    """Copy the shown geoms of a body."""
    first = int(mj.body_geomadr[body])
    for geom in range(first, first + int(mj.body_geomnum[body])):
        if int(mj.geom_group[geom]) >= SHOWN:
            continue
        kind = mujoco.mjtGeom(int(mj.geom_type[geom]))
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = int(mj.geom_dataid[geom])
            name = f"mesh_{mesh}"
            if spec.mesh(name) is None:
                vertices = _rows(mj.mesh_vert, mj.mesh_vertadr[mesh], mj.mesh_vertnum[mesh])
                faces = _rows(mj.mesh_face, mj.mesh_faceadr[mesh], mj.mesh_facenum[mesh])
                spec.add_mesh(
                    name=name,
                    uservert=vertices.astype(np.float32),
                    userface=faces.astype(np.int32),
                    inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
                )
            shape = made.add_geom(type=kind, meshname=name)
        elif kind in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD):
            continue
        else:
            shape = made.add_geom(type=kind, size=mj.geom_size[geom])
        material = int(mj.geom_matid[geom])
        colour = mj.mat_rgba[material] if material >= 0 else mj.geom_rgba[geom]
        finish(shape, mj.geom_pos[geom], mj.geom_quat[geom], np.array(colour, np.float64))


def _rows(values: Array, first: int, count: int) -> Array:
    """Return `count` rows of a table from row `first`, flat."""
    return np.array(values[int(first) : int(first) + int(count)]).reshape(-1)
