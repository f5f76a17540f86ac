"""The QP of one tick: what the tasks want, what contacts and joints allow.

Unknown are the generalised accelerations a (nv) and the wrenches f (6 per contact, in the sole's
axes at its centre). With M a + h the inverse dynamics and J the contacts' Jacobian,

    minimise  sum of task weight |jacobian a - target|^2          tasks
              + contact weights |J a + drift + BRAKE velocity|^2  soles stay where they are
              + posture weight |a - posture acceleration|^2       what is left free
              + wrench weight |f|^2 / share of the load           divides the load between the soles
              + LIMIT_WEIGHT |e|^2                                e: beyond the joints' limits
    subject to  first six rows of  M a + h = J^T f                Newton and Euler
                |other rows of  M a + h - J^T f| <= effort        joint torques
                low <= a_joints - e <= high                       joint positions and speeds
                C f <= 0,  0 <= f_normal <= limit                 contacts

(all terms halved). It has a solution for every state: f = 0 with any torques in their limits obeys
all constraints. Contacts and joint limits yield, by next to nothing, instead of ever contradicting
the hard ones.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import qpsolvers
from scipy.linalg.blas import dsymv

from preview_walk.robots.robot import Robot
from preview_walk.tracking.contacts import contact_rows
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.tasks import PostureTask, Task
from preview_walk.types import Array, Foot

CONTACT_WEIGHT = 1e4
"""Weight of a contact's acceleration: beside tasks of 100 and less, soles in walks err by 1e-4
m/s^2."""

TILT_WEIGHT = 1.0
"""Weight of a contact's roll and pitch, which yield: where an ankle is at its limit the sole tips
over its edge, and a QP that insisted on a flat one would throw the whole robot up to have it."""

LIMIT_WEIGHT = 1e3
"""Weight of the acceleration (rad/s^2) by which a joint misses what its limits ask."""

BASE_WEIGHT = 1e-4
"""Weight of the base's accelerations, so that the cost is strictly convex in every direction."""

BRAKE = 20.0
"""A contact's remaining velocity decays at this rate (1/s)."""

LIMIT_RATE = 30.0
"""Joints approach their limits no faster than exponentially at this rate (1/s)."""

_CONTACT_WEIGHTS = np.array([*3 * [CONTACT_WEIGHT], *2 * [TILT_WEIGHT], CONTACT_WEIGHT])

WRENCH_UNIT = np.array([100.0, 100.0, 100.0, 10.0, 10.0, 10.0])
"""Unit of the wrenches in `build`, so that its variables are of order one."""


class TickProblem:
    """The QP of one tick for a set of contacts and tasks; `fill` writes the current state.

    Attributes:
        robot, contacts, tasks, posture: what it is made of; `nv`, `n`, `nf`, `m`: numbers of
            accelerations, of joints, of wrench components, and of rows.
        rows, target, inverse_weight: (m, nv), (m,), (m,): rows @ a = target with these inverse
            weights (0: an equality), in the order tasks, contacts, base. The base's rows, the last
            six, have `wrench_map` (6, nf) @ f on their right-hand side.
        contact_jacobian: (nf, nv) those of the rows that are the contacts'.
        regularization_target, regularization_weight: (nv,) the accelerations drawn to, those of the
            posture, and their weights.
        wrench_weight: (nf,) per N^2 or (N·m)^2.
        contact_rows: (k, nf) with contact_rows @ f between `contact_low` and `contact_high` (k,).
        limits: (2, 2 n) lowest and highest values of the joints' torques and, beside them, of their
            accelerations.
        mass, bias: (nv, nv), (nv,) of the dynamics.
    """

    def __init__(
        self,
        robot: Robot,
        contacts: Sequence[Foot],
        tasks: Sequence[Task],
        posture: PostureTask,
        *,
        wrench_weight: float,
        friction: float,
        edge: float = 0.0,
    ) -> None:
        self.robot = robot
        self.contacts = tuple(contacts)
        self.tasks = tuple(tasks)
        self.posture = posture
        nv = robot.pin.nv
        self.nv, self.n, self.nf = nv, nv - 6, 6 * len(self.contacts)
        ny = sum(task.rows for task in tasks)
        self.m = ny + self.nf + 6

        self.rows: Array = np.zeros((self.m, nv))
        self.target: Array = np.zeros(self.m)
        self.inverse_weight: Array = np.zeros(self.m)
        self.inverse_weight[ny : ny + self.nf] = np.tile(1.0 / _CONTACT_WEIGHTS, len(self.contacts))
        self._task_rows = []
        at = 0
        for task in tasks:
            span = slice(at, at + task.rows)
            self._task_rows.append(
                (task, self.rows[span], self.target[span], self.inverse_weight[span])
            )
            at += task.rows
        self.contact_jacobian = self.rows[ny : ny + self.nf]
        self._contact_target = self.target[ny : ny + self.nf]
        self._base_rows, self._base_target = self.rows[-6:], self.target[-6:]
        self.wrench_map = self.contact_jacobian[:, :6].T

        self.regularization_target: Array = np.zeros(nv)
        self.regularization_weight = np.concatenate([np.full(6, BASE_WEIGHT), posture.weight])
        self.unit = np.tile(WRENCH_UNIT, len(self.contacts))
        self._wrench_weight = wrench_weight / self.unit**2
        self.wrench_weight = self._wrench_weight.copy()
        self.contact_rows, self.contact_low, self.contact_high = contact_rows(
            [robot.soles[foot] for foot in self.contacts], friction, edge
        )
        self._normal_high = self.contact_high[16::17]
        self._set_limits(robot)
        self.mass: Array = np.zeros((nv, nv))
        self.bias: Array = np.zeros(nv)

    def _set_limits(self, robot: Robot) -> None:
        """Write the limits of the torques, and what those of positions and speeds follow from."""
        self.limits: Array = np.zeros((2, 2 * self.n))
        self.limits[:, : self.n] = -robot.effort, robot.effort
        self._positions = LIMIT_RATE**2 * np.stack([robot.q_lower, robot.q_upper])
        self._speeds = LIMIT_RATE * np.stack([-robot.v_limit, robot.v_limit])
        self._reach = np.zeros((2, self.n))

    def __repr__(self) -> str:
        standing = " and ".join(self.contacts) or "no foot"
        return f"TickProblem({self.robot.name} on {standing}, {self.m} rows, {2 * self.n} limits)"

    def fill(
        self,
        dynamics: Dynamics,
        normal_limit: Mapping[Foot, float],
        shares: Sequence[float],
        settle: Mapping[Foot, Array],
    ) -> None:
        """Write the QP of the current state.

        Args:
            dynamics: at this state.
            normal_limit: largest normal force of each contact, N.
            shares: of the load on each contact, in their order.
            settle: twists (6,) of contacts that are not at rest, sole axes, m/s, rad/s.
        """
        self.mass, self.bias = dynamics.mass, dynamics.bias
        for task, jacobian, target, inverse_weight in self._task_rows:
            task.update(dynamics, jacobian, target)
            inverse_weight[:] = 1.0 / task.weight
        for k, foot in enumerate(self.contacts):
            terms, span = dynamics.soles[foot], slice(6 * k, 6 * k + 6)
            self.contact_jacobian[span] = terms.jacobian
            wanted = self._contact_target[span]
            np.multiply(terms.velocity, -BRAKE, out=wanted)
            if foot in settle:
                wanted += BRAKE * settle[foot]
            wanted -= terms.drift
            self._normal_high[k] = max(0.0, normal_limit[foot])
            np.divide(self._wrench_weight[span], shares[k], out=self.wrench_weight[span])
        self._base_rows[:] = dynamics.mass[:6]
        np.negative(dynamics.bias[:6], out=self._base_target)
        self.posture.target(dynamics, self.regularization_target[6:])
        self._fill_limits(dynamics.q[7:], dynamics.v[6:])

    def _fill_limits(self, q: Array, v: Array) -> None:
        """Write the joint accelerations that keep positions and speeds within their limits.

        The distance d to a limit obeys d'' >= -2 LIMIT_RATE d' - LIMIT_RATE^2 d, critically
        damped; a speed limit outranks a position limit, so that low <= high always holds.
        """
        wanted, (slowest, fastest) = self.limits[:, self.n :], self._reach
        rate = LIMIT_RATE * v
        moved = LIMIT_RATE**2 * q
        moved += rate
        moved += rate
        np.subtract(self._positions, moved, out=wanted)
        np.subtract(self._speeds, rate, out=self._reach)
        np.maximum(wanted, slowest, out=wanted)
        np.minimum(wanted, fastest, out=wanted)

    def forces(self, acceleration: Array, wrench: Array) -> Array:
        """Return M a + h - J^T f (nv,): nothing on the base, for a solution; the joint torques."""
        forces: Array = dsymv(1.0, self.mass, acceleration)
        forces += self.bias
        forces -= wrench @ self.contact_jacobian
        return forces

    def build(self) -> qpsolvers.Problem:
        """Return the QP of the current state, dense, to look at, save or solve with any backend.

        Its variables are [a; f; e], f in `WRENCH_UNIT` (see `split`). Constraints on forces are
        divided by 100, so that all rows are of order one.
        """
        nv, nf, n, unit = self.nv, self.nf, self.n, 100.0
        size = nv + nf + n
        free = slice(0, self.m - 6)
        weighted = self.rows[free].T / self.inverse_weight[free]
        P = np.diag(
            np.concatenate(
                [
                    self.regularization_weight,
                    self.wrench_weight * self.unit**2,
                    np.full(n, LIMIT_WEIGHT),
                ]
            )
        )
        P[:nv, :nv] += weighted @ self.rows[free]
        q = np.zeros(size)
        q[:nv] = (
            -self.regularization_weight * self.regularization_target - weighted @ self.target[free]
        )

        mass = np.triu(self.mass)
        dynamics = np.zeros((nv, size))
        dynamics[:, :nv] = mass + np.triu(mass, 1).T
        dynamics[:, nv : nv + nf] = -self.contact_jacobian.T * self.unit
        limits = np.zeros((2 * n, size))
        limits[:n] = dynamics[6:] / unit
        limits[n:, 6:nv] = np.eye(n)
        limits[n:, nv + nf :] = -np.eye(n)
        scale = np.repeat([1.0 / unit, 1.0], n)
        offset = np.concatenate([self.bias[6:], np.zeros(n)])
        low, high = (self.limits - offset) * scale
        cone = np.zeros((len(self.contact_rows), size))
        cone[:, nv : nv + nf] = self.contact_rows * self.unit / unit
        normal = np.arange(len(cone)) % 17 == 16
        G = np.vstack([limits, -limits, cone[~normal]])
        h = np.concatenate([high, -low, self.contact_high[~normal]])
        lb, ub = np.full(size, -np.inf), np.full(size, np.inf)
        pushes = nv + 2 + 6 * np.arange(len(self.contacts))
        lb[pushes], ub[pushes] = 0.0, self._normal_high / unit
        bounded = np.isfinite(h)
        return qpsolvers.Problem(
            P, q, G[bounded], h[bounded], dynamics[:6] / unit, -self.bias[:6] / unit, lb, ub
        )

    def split(self, z: Array) -> tuple[Array, Array]:
        """Return the accelerations (nv,) and wrenches (nf,), SI units, of a solution of `build`."""
        nv, nf = self.nv, self.nf
        return z[:nv], z[nv : nv + nf] * self.unit
