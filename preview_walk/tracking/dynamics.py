"""The robot's dynamics at one state: every term that the QP of a tick needs, computed once."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array, Foot

_LOCAL = pin.ReferenceFrame.LOCAL


class FrameTerms:
    """A frame of the robot at the current state.

    - `rotation` (3, 3), `position` (3,): placement in the world.
    - `velocity` (6,): [linear; angular] in m/s and rad/s, in the frame's own axes.
    - `jacobian` (6, nv): velocity = jacobian @ v, in the frame's own axes.
    - `drift` (6,): classical acceleration at zero joint acceleration, in the frame's own axes, so
      that the acceleration is jacobian @ a + drift.
    """

    def __init__(self, frame: int, nv: int) -> None:
        self.frame = frame
        self.rotation: Array = np.eye(3)
        self.position: Array = np.zeros(3)
        self.velocity: Array = np.zeros(6)
        self.jacobian: Array = np.zeros((6, nv))
        self.drift: Array = np.zeros(6)


class Dynamics:
    """Terms of `mass @ a + bias = [0; tau] + sum of jacobian.T @ wrench` at one state.

    Pinocchio's conventions: base velocity in base axes. Call `update(q, v)` once a tick.

    - `mass` (nv, nv): upper triangle of the joint-space inertia (armature included); the lower
      triangle is undefined.
    - `bias` (nv,): Coriolis, centrifugal and gravity terms, and viscous joint friction.
    - `com`, `com_velocity` (3,) in the world; `com_jacobian` (3, nv); `com_drift` (3,).
    - `feet`: `FrameTerms` of the soles; `torso`: of the trunk.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.model = robot.pin
        self.data = robot.pin.createData()
        nv = robot.pin.nv
        self.nv = nv
        self.q: Array = np.array(robot.posture)
        self.v: Array = np.zeros(nv)
        self._still = np.zeros(nv)
        self._damping = np.concatenate([np.zeros(6), robot.damping])
        self._gravity = np.array(robot.pin.gravity.linear)
        self.mass: Array = self.data.M
        self.bias: Array = np.zeros(nv)
        self.com: Array = np.zeros(3)
        self.com_velocity: Array = np.zeros(3)
        self.com_jacobian: Array = np.zeros((3, nv))
        self.com_drift: Array = np.zeros(3)
        self.base_rotation: Array = np.eye(3)
        self.feet: dict[Foot, FrameTerms] = {
            foot: FrameTerms(robot.soles[foot].frame, nv) for foot in FEET
        }
        self.torso = FrameTerms(robot.torso, nv)
        self._frames = (*self.feet.values(), self.torso)

    def update(self, q: Array, v: Array) -> None:
        """Compute every term at configuration q (nq,) and velocity v (nv,)."""
        model, data = self.model, self.data
        self.q, self.v = q, v
        pin.crba(model, data, q)
        pin.nonLinearEffects(model, data, q, v)
        pin.forwardKinematics(model, data, q, v, self._still)
        pin.computeJointJacobians(model, data)
        np.multiply(self._damping, v, out=self.bias)
        self.bias += data.nle
        for terms in self._frames:
            placement = pin.updateFramePlacement(model, data, terms.frame)
            terms.rotation, terms.position = placement.rotation, placement.translation
            terms.jacobian = pin.getFrameJacobian(model, data, terms.frame, _LOCAL)
            terms.velocity = terms.jacobian @ v
            terms.drift = pin.getFrameClassicalAcceleration(
                model, data, terms.frame, _LOCAL
            ).vector
        # The base's linear rows are the robot's linear momentum in base axes (m J_com).
        rotation = data.oMi[1].rotation
        self.base_rotation = rotation
        over_mass = rotation / self.robot.mass
        base_rows = self.mass[:3]
        np.matmul(over_mass, base_rows, out=self.com_jacobian)
        self.com_jacobian[:, :3] = over_mass @ self._symmetric_corner(base_rows)
        self.com_drift = over_mass @ data.nle[:3] + self._gravity
        self.com = pin.centerOfMass(model, data, q, False)
        self.com_velocity = self.com_jacobian @ v

    @staticmethod
    def _symmetric_corner(rows: Array) -> Array:
        """Return the 3 x 3 corner with its lower triangle filled in."""
        corner = rows[:, :3]
        return np.triu(corner) + np.triu(corner, 1).T
