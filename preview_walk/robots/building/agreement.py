"""Do the two engines see the same robot? Asked at every load, on a few fixed states."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.state import to_mujoco
from preview_walk.types import Array, Foot

TOLERANCE = 1e-8
"""Largest difference between the engines, relative to the term's largest entry."""


def disagreement(
    mj: mujoco.MjModel, model: pin.Model, soles: Mapping[Foot, tuple[str, int]], states: int = 2
) -> dict[str, float]:
    """Return the largest relative difference of every term between MuJoCo and Pinocchio.

    Compared are mass matrix (armature included), bias forces, CoM, sole poses and sole Jacobians,
    all in MuJoCo's velocity convention.

    Args:
        mj: MuJoCo's model.
        model: Pinocchio's.
        soles: MuJoCo site and Pinocchio frame of each sole.
        states: how many seeded random states to compare at.
    """
    random = np.random.default_rng(0)
    data, pin_data = mujoco.MjData(mj), model.createData()
    worst: dict[str, float] = {}
    for _ in range(states):
        q = random.uniform(-1.0, 1.0, model.nq)
        q[3:7] /= np.linalg.norm(q[3:7])
        v = random.uniform(-1.0, 1.0, model.nv)
        to_mujoco(q, v, data.qpos, data.qvel)
        mujoco.mj_fwdPosition(mj, data)
        mujoco.mj_fwdVelocity(mj, data)
        pairs = _terms((mj, data), (model, pin_data), q, v, soles)
        for name, (ours, theirs) in pairs.items():
            scale = max(float(np.abs(ours).max()), 1e-3)
            gap = float(np.abs(ours - theirs).max()) / scale
            worst[name] = max(worst.get(name, 0.0), gap)
    return worst


def _terms(
    one: tuple[mujoco.MjModel, mujoco.MjData],
    two: tuple[pin.Model, pin.Data],
    q: Array,
    v: Array,
    soles: Mapping[Foot, tuple[str, int]],
) -> dict[str, tuple[Array, Array]]:
    """Return MuJoCo's and Pinocchio's value of every term at a state."""
    (mj, data), (model, pin_data) = one, two
    rotation = pin.Quaternion(q[3:7]).toRotationMatrix()
    # v_pin = turn @ v_mj; its rate of change adds a Coriolis term to the base's acceleration.
    turn = np.eye(model.nv)
    turn[:3, :3] = rotation.T
    drift = np.zeros(model.nv)
    drift[:3] = -np.cross(v[3:6], v[:3])
    mass = np.zeros((mj.nv, mj.nv))
    mujoco.mj_fullM(mj, data, mass)
    pin.crba(model, pin_data, q)
    upper = np.triu(pin_data.M)
    full = upper + np.triu(upper, 1).T
    bias = pin.rnea(model, pin_data, q, v, drift)
    pin.computeJointJacobians(model, pin_data, q)
    pin.updateFramePlacements(model, pin_data)
    terms = {
        "mass matrix": (mass, turn.T @ full @ turn),
        "bias forces": (np.array(data.qfrc_bias), turn.T @ bias),
        "centre of mass": (
            np.array(data.subtree_com[1]),
            np.array(pin.centerOfMass(model, pin_data, q)),
        ),
    }
    for foot, (site, frame) in soles.items():
        linear, angular = np.zeros((3, mj.nv)), np.zeros((3, mj.nv))
        mujoco.mj_jacSite(mj, data, linear, angular, mj.site(site).id)
        jacobian = pin.getFrameJacobian(
            model, pin_data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        )
        terms[f"{foot} sole's Jacobian"] = (np.vstack((linear, angular)), jacobian @ turn)
        placed = pin_data.oMf[frame]
        terms[f"{foot} sole's pose"] = (
            np.hstack((data.site(site).xpos, data.site(site).xmat)),
            np.hstack((placed.translation, placed.rotation.reshape(9))),
        )
    return terms


def check_agreement(
    mj: mujoco.MjModel, model: pin.Model, soles: Mapping[Foot, tuple[str, int]]
) -> None:
    """Compare the two engines at two states.

    Args:
        mj: MuJoCo's model.
        model: Pinocchio's.
        soles: MuJoCo site and Pinocchio frame of each sole.

    Raises:
        RobotError: they disagree; names the worst term.
    """
    worst = disagreement(mj, model, soles)
    term = max(worst, key=lambda name: worst[name])
    if not worst[term] < TOLERANCE:
        raise RobotError(
            f"MuJoCo and Pinocchio disagree about the {term} by {worst[term]:.2g} of its largest "
            f"entry; expected less than {TOLERANCE:g}"
        )
