"""The joints' way through a swing, by inverse kinematics: soles, CoM and an upright trunk."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from preview_walk.geometry.poses import pose_at
from preview_walk.robots.building.inverse_kinematics import sole_rows
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import stance_of
from preview_walk.types import FEET, Array, Foot

STRAIGHTEST = 0.05
"""The knees keep this bend (rad): past it the leg would be too short, not bent the other way."""

SOFT = 0.02
"""Damping of the inverse kinematics (m per rad): a leg nearly straight turns no faster for it."""

_CLOSE = 1e-5
"""Soles and CoM are where they should be within this (m, rad)."""

_FIRST, _NEXT = 15, 5
"""Iterations at most, at the first instant and at those that follow."""


class JointPath:
    """Inverse kinematics of one robot, from instant to instant."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._model = robot.pin
        self._data = robot.pin.createData()
        self._free = np.array(stance_of(robot).free)
        self._upright = pin.XYZQUATToSE3(robot.posture[:7])
        knees = [robot.pin.joints[robot.legs[foot].knee] for foot in FEET]
        self._knees = [
            (knee.idx_q, knee.idx_v, np.sign(robot.posture[knee.idx_q]) or 1.0) for knee in knees
        ]

    def configurations(
        self, soles: Mapping[Foot, list[Array]], com: Array, heading: float
    ) -> Array:
        """Return configurations (N, nq) with the soles and the CoM where they should be.

        What the legs cannot reach is shared between soles and CoM.

        Args:
            soles: N poses (4, 4) for each foot, world, m.
            com: (N, 3) in the world, m.
            heading: yaw of the trunk, rad.
        """
        q = np.array(self._robot.posture)
        turned = pin.SE3(pose_at(0.0, 0.0, heading)) * self._upright
        turned.translation[:2] += com[0, :2]
        turned.translation[2] += float(soles["left"][0][2, 3])
        q[:7] = pin.SE3ToXYZQUAT(turned)
        path = np.zeros((len(com), len(q)))
        for k in range(len(com)):
            targets = {foot: pin.SE3(np.array(soles[foot][k])) for foot in FEET}
            for _ in range(_NEXT if k else _FIRST):
                error, jacobian = self._residual(q, targets, com[k], turned.rotation)
                if np.abs(error).max() < _CLOSE:
                    break
                q = self._moved(q, error, jacobian)
            path[k] = q
        return path

    def _residual(
        self, q: Array, targets: Mapping[Foot, pin.SE3], com: Array, upright: Array
    ) -> tuple[Array, Array]:
        """Return errors (18,) of soles, CoM and trunk, and their Jacobian by the free joints."""
        model, data, robot = self._model, self._data, self._robot
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        errors, rows = [], []
        for foot in FEET:
            unplaced = robot.legs[foot].unplaced
            error, jacobian = sole_rows(
                model, data, robot.soles[foot].frame, targets[foot], unplaced
            )
            errors.append(error)
            rows.append(jacobian)
        errors += [
            pin.centerOfMass(model, data, q) - com,
            pin.log3(upright.T @ data.oMi[1].rotation),
        ]
        rows += [
            pin.jacobianCenterOfMass(model, data, q),
            pin.getJointJacobian(model, data, 1, pin.ReferenceFrame.LOCAL)[3:],
        ]
        return np.concatenate(errors), np.vstack(rows)[:, self._free]

    def _moved(self, q: Array, error: Array, jacobian: Array) -> Array:
        """Return the next configuration; a knee that would pass its straightest stays there."""
        free, held = self._free, np.zeros(len(self._free), bool)
        for _ in range(len(self._knees) + 1):
            rows = np.where(held, 0.0, jacobian)
            step = np.zeros(self._model.nv)
            damped = rows @ rows.T + SOFT**2 * np.eye(len(error))
            step[free] = -rows.T @ np.linalg.solve(damped, error)
            past = [
                (at, v, bend)
                for at, v, bend in self._knees
                if bend * (q[at] + step[v]) < STRAIGHTEST - 1e-9 and not held[free == v].any()
            ]
            if not past:
                break
            for at, v, bend in past:
                q[at] = bend * STRAIGHTEST
                held |= free == v
        return np.asarray(pin.integrate(self._model, q, step))
