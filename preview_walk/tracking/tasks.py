"""Tasks: what the robot's motion should be, each as a linear least-squares term in the QP.

A task asks for `jacobian @ a = target` (a: generalised accelerations) with a weight. One's own
task is a class with `rows`, `weight` and `update`; see `examples/own_task.py`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
import pinocchio as pin

from preview_walk.tracking.dynamics import Dynamics
from preview_walk.types import Array, Foot


class Task(Protocol):
    """A least-squares term `weight * |jacobian @ a - target|^2` of the QP."""

    rows: int
    """Number of equations."""
    weight: float
    """Importance relative to the other tasks, in 1 / (unit of the acceleration)^2; positive."""

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """Write the task at the current state.

        Args:
            dynamics: at the measured state.
            jacobian: (rows, nv) to be filled.
            target: (rows,) to be filled.
        """


class CoMTask:
    """The CoM's acceleration follows `acceleration` (3,), world, m/s^2."""

    rows = 3

    def __init__(self, weight: float) -> None:
        self.weight = weight
        self.acceleration: Array = np.zeros(3)

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """See `Task.update`."""
        jacobian[:] = dynamics.com_jacobian
        np.subtract(self.acceleration, dynamics.com_drift, out=target)


class FootTask:
    """A foot's sole follows a pose with its velocity and acceleration.

    Attributes:
        foot: whose sole.
        weight: see `Task`.
        stiffness, damping: of the feedback, critically damped, 1/s^2, 1/s.
        pose: (4, 4) wanted, world, m.
        velocity, acceleration: (6,) wanted [linear; angular], world, m/s, rad/s (and per s).
        unplaced: rows, in the sole's axes, of what the leg cannot do and is not asked for.
    """

    rows = 6

    def __init__(
        self, foot: Foot, weight: float, frequency: float, unplaced: Sequence[int] = ()
    ) -> None:
        self.foot: Foot = foot
        self.weight = weight
        self.unplaced = list(unplaced)
        self.stiffness, self.damping = frequency**2, 2.0 * frequency
        self.pose: Array = np.eye(4)
        self.velocity: Array = np.zeros(6)
        self.acceleration: Array = np.zeros(6)

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """See `Task.update`."""
        terms = dynamics.soles[self.foot]
        rotation, pose = terms.rotation, self.pose
        jacobian[:] = terms.jacobian
        # The reference's own motion and the pull towards it, turned into the sole's axes.
        wanted = self.damping * self.velocity
        wanted += self.acceleration
        wanted[:3] += self.stiffness * (pose[:3, 3] - terms.position)
        np.matmul(wanted.reshape(2, 3), rotation, out=target.reshape(2, 3))
        target[3:] += self.stiffness * pin.log3(rotation.T @ pose[:3, :3])
        target -= self.damping * terms.velocity
        target -= terms.drift
        if self.unplaced:
            jacobian[self.unplaced], target[self.unplaced] = 0.0, 0.0


class TorsoTask:
    """The trunk keeps an orientation.

    Attributes:
        weight: see `Task`.
        stiffness, damping: of the feedback, critically damped, 1/s^2, 1/s.
        rotation: (3, 3) wanted, from the trunk's axes to the world's.
        velocity: (3,) wanted angular velocity, world axes, rad/s.
    """

    rows = 3

    def __init__(self, weight: float, frequency: float) -> None:
        self.weight = weight
        self.stiffness, self.damping = frequency**2, 2.0 * frequency
        self.rotation: Array = np.eye(3)
        self.velocity: Array = np.zeros(3)

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """See `Task.update`."""
        terms = dynamics.torso
        rotation = terms.rotation
        jacobian[:] = terms.jacobian[3:]
        np.matmul(self.velocity, rotation, out=target)
        target -= terms.velocity[3:]
        target *= self.damping
        target += self.stiffness * pin.log3(rotation.T @ self.rotation)
        target -= terms.drift[3:]


class AngularMomentumTask:
    """The angular momentum about the CoM is drawn to a value.

    Attributes:
        weight: see `Task`, 1/(N·m)^2.
        rate: at which the difference decays, 1/s.
        momentum: (3,) wanted, world axes, N·m·s.
    """

    rows = 3

    def __init__(self, weight: float, rate: float) -> None:
        self.weight = weight
        self.rate = rate
        self.momentum: Array = np.zeros(3)

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """See `Task.update`."""
        dynamics.update_momentum()
        jacobian[:] = dynamics.momentum_jacobian
        target[:] = self.rate * (self.momentum - jacobian @ dynamics.v)
        target -= dynamics.momentum_drift


class PostureTask:
    """Joints are drawn to a posture: what the other tasks leave free.

    It is the QP's own diagonal, not rows. Loose joints are only damped: legs, whose configuration
    follows from feet, CoM and torso, so that a pull towards the posture would only bend these.

    Attributes:
        posture: (n,) joint positions, rad.
        weight: (n,) per joint, 1/(rad/s^2)^2.
        stiffness: (n,) of the feedback, 1/s^2; 0 for loose joints.
        damping: of the feedback, 1/s.
    """

    def __init__(
        self, posture: Array, weight: Array, frequency: float, loose: Sequence[int] = ()
    ) -> None:
        self.posture = posture
        self.weight = weight
        self.stiffness = np.full(len(posture), frequency**2)
        self.stiffness[list(loose)] = 0.0
        self.damping = 2.0 * frequency

    def target(self, dynamics: Dynamics, target: Array) -> None:
        """Write into `target` (n,) the accelerations that lead to the posture, in rad/s^2."""
        np.subtract(self.posture, dynamics.q[7:], out=target)
        target *= self.stiffness
        target -= self.damping * dynamics.v[6:]
