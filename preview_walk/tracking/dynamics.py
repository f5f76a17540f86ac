"""The robot's dynamics at one state: every term that the QP of a tick needs, computed once."""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array, Foot

_LOCAL = pin.ReferenceFrame.LOCAL
_WORLD = pin.Convention.WORLD


class FrameTerms:
    """A frame of the robot at the current state; valid until the next `Dynamics.update`.

    Attributes:
        frame: its id in the Pinocchio model.
        rotation: (3, 3) from the frame's axes to the world's.
        position: (3,) of its origin in the world, m.
        velocity: (6,) [linear; angular], the frame's own axes, m/s, rad/s.
        jacobian: (6, nv) with velocity = jacobian @ v, the frame's own axes.
        drift: (6,) classical acceleration at zero joint acceleration, the frame's own axes: the
            acceleration is jacobian @ a + drift.
    """

    def __init__(self, owner: Dynamics, frame: int) -> None:
        """Look at a frame (Pinocchio's id) of the dynamics that will keep it up to date."""
        self._owner = owner
        self.frame = frame
        model, data = owner.model, owner.data
        # Views of Pinocchio's own memory: they follow every update of the placement.
        self.rotation: Array = data.oMf[frame].rotation
        self.position: Array = data.oMf[frame].translation
        self.velocity: Array = np.zeros(6)
        self.jacobian: Array = np.zeros((6, model.nv))
        self.drift: Array = np.zeros(6)

    def __reduce__(self) -> tuple[Any, ...]:
        """Find the same frame of the copied dynamics, whose memory the views look at."""
        return _frame_of, (self._owner, self.frame)

    @property
    def pose(self) -> Array:
        """A copy (4, 4) of the frame's pose in the world, m."""
        pose = np.zeros((4, 4))
        pose[:3, :3], pose[:3, 3], pose[3, 3] = self.rotation, self.position, 1.0
        return pose

    def update(self, model: pin.Model, data: pin.Data) -> None:
        """Read the frame's terms after Pinocchio has computed those of the joints."""
        frame = self.frame
        pin.updateFramePlacement(model, data, frame)
        self.jacobian = pin.getFrameJacobian(model, data, frame, _LOCAL)
        self.velocity = pin.getFrameVelocity(model, data, frame, _LOCAL).vector
        self.drift = pin.getFrameClassicalAcceleration(model, data, frame, _LOCAL).vector


class Dynamics:
    """Terms of `mass @ a + bias = [0; tau] + sum of jacobian.T @ wrench` at one state.

    Pinocchio's conventions: base velocity in base axes. Call `update(q, v)` once a tick; what the
    attributes hold is valid until the next call.

    Attributes:
        robot, model, data: the robot, and Pinocchio's model and workspace.
        q, v: (nq,), (nv,) the state.
        mass: (nv, nv) joint-space inertia, armature included: its upper triangle and its first six
            rows; the rest of the lower triangle is undefined.
        bias: (nv,) Coriolis, centrifugal and gravity terms, and viscous joint friction.
        com, com_velocity: (3,) in the world, m, m/s.
        com_jacobian, com_drift: (3, nv), (3,): the CoM's acceleration is
            com_jacobian @ a + com_drift, world axes.
        momentum_jacobian, momentum_drift: (3, nv), (3,) of the angular momentum about the CoM,
            world axes, and of its rate; for the drift call `update_momentum` first.
        soles: the `FrameTerms` of each sole frame.
        torso: those of the trunk; `frame` gives any other's.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.model = robot.pin
        self.data = data = robot.pin.createData()
        nv = robot.pin.nv
        self.nv = nv
        self.q: Array = np.array(robot.posture)
        self.v: Array = np.zeros(nv)
        self._still = np.zeros(nv)
        self._damping = np.concatenate([np.zeros(6), robot.damping])
        self._gravity = np.array(robot.pin.gravity.linear)
        self._over_mass = 1.0 / robot.mass
        self.mass: Array = data.M
        self.bias: Array = np.zeros(nv)
        self.com: Array = data.com[0]
        self.com_velocity: Array = np.zeros(3)
        self.com_jacobian: Array = np.zeros((3, nv))
        self.com_drift: Array = np.zeros(3)
        self.momentum_jacobian: Array = data.Ag[3:]
        self.momentum_drift: Array = np.zeros(3)
        self._nle: Array = data.nle
        self._base_rotation: Array = data.oMi[1].rotation
        self._base_position: Array = data.oMi[1].translation
        self._linear_momentum: Array = data.Ag[:3]
        self._frames: dict[int, FrameTerms] = {}
        self.soles: dict[Foot, FrameTerms] = {
            foot: self.add_frame(robot.soles[foot].frame) for foot in FEET
        }
        self.torso = self.add_frame(robot.torso)
        self.update(self.q, self.v)

    def __repr__(self) -> str:
        return f"Dynamics({self.robot.name}, nv = {self.nv})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Compute the terms of the copy anew: they are views of Pinocchio's own memory."""
        return _dynamics_at, (self.robot, np.array(self.q), np.array(self.v), [*self._frames])

    def frame(self, name: str) -> FrameTerms:
        """Return the terms of a frame of the Pinocchio model, kept up to date from now on.

        Args:
            name: of the frame.

        Raises:
            InvalidInput: the model has no frame of that name.
        """
        if not self.model.existFrame(name):
            raise InvalidInput(
                f"expected the name of a frame of {self.robot.name}, got '{name}'; it has "
                f"{', '.join(frame.name for frame in self.model.frames)}.",
                "name",
            )
        terms = self.add_frame(self.model.getFrameId(name))
        terms.update(self.model, self.data)
        return terms

    def add_frame(self, frame: int) -> FrameTerms:
        """Return the terms of a frame by its Pinocchio id, kept up to date from the next update."""
        if frame not in self._frames:
            self._frames[frame] = FrameTerms(self, frame)
        return self._frames[frame]

    def update(self, q: Array, v: Array) -> None:
        """Compute every term at configuration q (nq,) and velocity v (nv,)."""
        model, data = self.model, self.data
        self.q, self.v = q, v
        # In Pinocchio's world convention these three calls leave behind all that the tasks need:
        # the mass matrix, the matrix of the momentum about the CoM, the CoM and the joints'
        # Jacobians (crba), the bias forces, and the joints' velocities and drifts.
        pin.crba(model, data, q, _WORLD)
        pin.nonLinearEffects(model, data, q, v)
        pin.forwardKinematics(model, data, q, v, self._still)
        for terms in self._frames.values():
            terms.update(model, data)
        np.multiply(self._damping, v, out=self.bias)
        self.bias += self._nle
        # Linear momentum is m J_com @ v; the base's linear rows of the dynamics are Newton's law
        # for the whole robot, in base axes.
        np.multiply(self._linear_momentum, self._over_mass, out=self.com_jacobian)
        np.matmul(self._base_rotation, self._nle[:3], out=self.com_drift)
        self.com_drift *= self._over_mass
        self.com_drift += self._gravity
        self.com_velocity = self.com_jacobian @ v

    def add_lift(self, force: float, moment: Array) -> None:
        """Let the base bear what lifts the robot, until the next `update`.

        Args:
            force: upward, through the CoM, N.
            moment: (3,) about the CoM, world axes, N·m.
        """
        up = force * self._base_rotation[2]
        self.bias[:3] -= up
        self.bias[3:6] -= moment @ self._base_rotation
        self.bias[3:6] -= np.cross((self.com - self._base_position) @ self._base_rotation, up)

    def spin(self) -> Array:
        """Return how fast (3,) the whole robot turns, world axes, rad/s.

        So fast its base would turn if all joints were locked now.
        """
        matrix = self.momentum_jacobian
        value: Array = self._base_rotation @ np.linalg.solve(matrix[:, 3:6], matrix @ self.v)
        return value

    def update_momentum(self) -> None:
        """Compute `momentum_drift`; only a momentum task needs it.

        The base's rows of the bias, moved to the CoM, about which gravity has no moment.
        """
        rotation, lever = self._base_rotation, self.com - self._base_position
        force, moment = rotation @ self._nle[:3], rotation @ self._nle[3:6]
        np.subtract(moment, np.cross(lever, force), out=self.momentum_drift)


def _dynamics_at(robot: Robot, q: Array, v: Array, frames: list[int]) -> Dynamics:
    """Return the dynamics at a state, with these frames kept up to date."""
    dynamics = Dynamics(robot)
    for frame in frames:
        dynamics.add_frame(frame)
    dynamics.update(q, v)
    return dynamics


def _frame_of(dynamics: Dynamics, frame: int) -> FrameTerms:
    """Return the terms of a frame that the dynamics keep up to date."""
    return dynamics.add_frame(frame)
