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
        """Write the task at the current state into `jacobian` (rows, nv) and `target` (rows,)."""


class CoMTask:
    """The CoM's acceleration (3,) in the world follows `acceleration`, in m/s^2."""

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

    Feedback of natural frequency `frequency` (rad/s), critically damped. The reference is the sole
    pose (4, 4), velocity (6,) and acceleration (6,) [linear; angular], all in the world.
    `unplaced`: rows, in the sole's axes, of what the leg cannot do and is not asked for.
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
    """The trunk keeps the orientation `rotation` (3, 3), turning at `velocity` (3,), world axes."""

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
    """The angular momentum about the CoM, world axes, is drawn to `momentum` (3,) at `rate` (1/s).

    Its weight is in 1 / (N·m)^2.
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
    """Joints are drawn to `posture` (n,): what the other tasks leave free.

    It is the QP's own diagonal, not rows: `weight` (n,) holds a weight per joint and `target` the
    wanted joint acceleration (n,). The joints listed in `loose` are only damped: legs, whose
    configuration follows from feet, CoM and torso, so that a pull towards the posture would only
    bend these tasks.
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
