"""The QP of one tick: fixed sparsity for a set of contacts, values written in place.

Variables z = [a; f; y]: generalised accelerations a (nv), the wrench f of every contact (6 each,
`WRENCH_UNIT`), and one slack per task row. Rows, as lower <= A z <= upper:

| rows | meaning |
|---|---|
| 6 | base rows of `mass a + bias = jacobian^T f` (over `TORQUE_UNIT`) |
| 6 per contact | the sole's acceleration is zero (its velocity is damped) |
| task rows | sqrt(weight) (jacobian a - target) = y |
| n | joint torques within limits (over `TORQUE_UNIT`) |
| 17 per contact | wrench cone, and the normal force between 0 and its limit |
| n | joint accelerations that keep positions and speeds within limits |

Cost: |y|^2 / 2 + posture weight |a_joints - posture target|^2 / 2 + wrench weight |f|^2 / 2. The
slack keeps the cost's matrix constant and diagonal, so a tick changes entries of A only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pinocchio as pin
import scipy.sparse as sparse

from preview_walk.robots.robot import Robot
from preview_walk.tracking.contacts import sole_cone
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.tasks import PostureTask, Task
from preview_walk.types import Array, Foot

WRENCH_UNIT = np.array([100.0, 100.0, 100.0, 10.0, 10.0, 10.0])
"""Unit of the contact variables: 100 N and 10 N·m, so that a sole's wrench is of order one."""

TORQUE_UNIT = 100.0
"""Unit of the dynamics rows in N and N·m."""

BASE_WEIGHT = 1e-4
"""Weight of the base's accelerations, so that the cost is strictly convex in every direction."""

BRAKE = 100.0
"""A contact's remaining velocity decays at this rate (1/s)."""

CONTACT = 100.0
LIMIT = 10.0
LIMIT_HORIZON = 0.05
"""Time (s) within which a joint may come to its position limit."""


class TickProblem:
    """The QP of one tick for a fixed set of contacts and tasks.

    `fill` writes the current state; `P`, `A` (CSC), `q`, `lower`, `upper` are then the QP

        minimise 1/2 z^T P z + q^T z  subject to  lower <= A z <= upper.
    """

    def __init__(
        self,
        robot: Robot,
        contacts: Sequence[Foot],
        tasks: Sequence[Task],
        posture: PostureTask,
        wrench_weight: float,
        friction: float,
    ) -> None:
        self.robot = robot
        self.contacts = tuple(contacts)
        self.tasks = tuple(tasks)
        self.posture = posture
        nv, n = robot.pin.nv, robot.pin.nv - 6
        self.nv, self.nf = nv, 6 * len(self.contacts)
        rows = [task.rows for task in tasks]
        self.ny = sum(rows)
        self.nc = self.nf
        self.n = nv + self.nf + self.ny + self.nc + n
        self._normal = nv + 2 + 6 * np.arange(len(self.contacts))

        # Rows, in the order of the table above.
        spans = {}
        at = 0
        for name, size in (
            ("base", 6),
            ("contact", self.nf),
            ("task", self.ny),
            ("torque", n),
            ("cone", 16 * len(self.contacts)),
            ("normal", len(self.contacts)),
            ("limit", n),
        ):
            spans[name] = slice(at, at + size)
            at += size
        self.spans = spans
        self.m = at

        # Where every moving entry of A comes from: `source` holds, one after the other, the mass
        # matrix, the contact Jacobians, the task Jacobians and a one for constant entries.
        mass_size = nv * nv
        self._contact_at = mass_size
        self._task_at = self._contact_at + 6 * nv * len(self.contacts)
        one = self._task_at + self.ny * nv
        self._source = np.zeros(one + 1)
        self._source[one] = 1.0
        self._mass = self._source[:mass_size]
        self._jacobians = [
            self._source[self._contact_at + 6 * nv * k :][: 6 * nv].reshape(6, nv)
            for k in range(len(self.contacts))
        ]
        starts = np.concatenate([[0], np.cumsum(rows)]).astype(int)
        self._task_jacobians = [
            self._source[self._task_at + s * nv : self._task_at + (s + r) * nv].reshape(r, nv)
            for s, r in zip(starts, rows, strict=False)
        ]
        self._task_target = np.zeros(self.ny)
        self._task_targets = [
            self._task_target[s : s + r] for s, r in zip(starts, rows, strict=False)
        ]
        self._task_scale = np.repeat([task.weight**0.5 for task in tasks], rows)

        entries: list[tuple[int, int, int, float]] = []  # row, column, source, scale
        related = _related_dofs(robot.pin)
        for i in range(nv):
            row = spans["base"].start + i if i < 6 else spans["torque"].start + i - 6
            for j in range(nv):
                if related[i, j]:  # the upper triangle, column-major
                    entries.append((row, j, max(i, j) * nv + min(i, j), 1.0 / TORQUE_UNIT))
            for k, foot in enumerate(self.contacts):
                if related[i, _tip_dof(robot, foot)]:
                    for r in range(6):
                        source = self._contact_at + (6 * k + r) * nv + i
                        scale = -WRENCH_UNIT[r] / TORQUE_UNIT
                        entries.append((row, nv + 6 * k + r, source, scale))
        for k, foot in enumerate(self.contacts):
            for r in range(6):
                for j in np.flatnonzero(related[:, _tip_dof(robot, foot)]):
                    source = self._contact_at + (6 * k + r) * nv + int(j)
                    entries.append((spans["contact"].start + 6 * k + r, int(j), source, CONTACT))
                entries.append((spans["contact"].start + 6 * k + r, nv + self.nf + self.ny + 6 * k + r, one, -1.0))
        for r in range(self.ny):
            row = spans["task"].start + r
            for j in range(nv):
                entries.append((row, j, self._task_at + r * nv + j, float(self._task_scale[r])))
            entries.append((row, nv + self.nf + r, one, -1.0))
        for k, foot in enumerate(self.contacts):
            cone = sole_cone(robot.soles[foot], friction) * WRENCH_UNIT / WRENCH_UNIT[0]
            for r, c in zip(*np.nonzero(cone), strict=True):
                row = spans["cone"].start + 16 * k + int(r)
                entries.append((row, nv + 6 * k + int(c), one, float(cone[r, c])))
            entries.append((spans["normal"].start + k, nv + 6 * k + 2, one, 1.0))
        for j in range(n):
            entries.append((spans["limit"].start + j, 6 + j, one, 1.0))
            entries.append((spans["limit"].start + j, nv + self.nf + self.ny + self.nc + j, one, 1.0))

        order = sorted(range(len(entries)), key=lambda e: (entries[e][1], entries[e][0]))
        row_of = np.array([entries[e][0] for e in order], dtype=np.int32)
        column_of = np.array([entries[e][1] for e in order])
        self._gather = np.array([entries[e][2] for e in order])
        self._scale = np.array([entries[e][3] for e in order])
        starts_of = np.searchsorted(column_of, np.arange(self.n + 1)).astype(np.int32)
        self.A = sparse.csc_matrix(
            (np.zeros(len(order)), row_of, starts_of), shape=(self.m, self.n)
        )
        diagonal = np.concatenate(
            [
                np.full(6, BASE_WEIGHT),
                posture.weight,
                np.full(self.nf, wrench_weight),
                np.ones(self.ny + self.nc),
                np.full(n, LIMIT),
            ]
        )
        self.P = sparse.diags(diagonal, format="csc")
        self.q: Array = np.zeros(self.n)
        self.lower: Array = np.full(self.m, -np.inf)
        self.upper: Array = np.full(self.m, np.inf)
        self.upper[spans["cone"]] = 0.0
        self.lower[spans["normal"]] = 0.0
        self._effort = robot.effort / TORQUE_UNIT

    def fill(self, dynamics: Dynamics, normal_limit: Mapping[Foot, float]) -> None:
        """Write the QP of the current state; `normal_limit` (N) caps each contact's normal force."""
        spans, lower, upper = self.spans, self.lower, self.upper
        self._mass[:] = dynamics.mass.ravel(order="F")
        bias = dynamics.bias / TORQUE_UNIT
        lower[spans["base"]] = upper[spans["base"]] = -bias[:6]
        for k, foot in enumerate(self.contacts):
            terms = dynamics.feet[foot]
            self._jacobians[k][:] = terms.jacobian
            at = spans["contact"].start + 6 * k
            lower[at : at + 6] = upper[at : at + 6] = CONTACT * (-terms.drift - BRAKE * terms.velocity)
            upper[spans["normal"].start + k] = normal_limit[foot] / WRENCH_UNIT[2]
        for task, jacobian, target in zip(
            self.tasks, self._task_jacobians, self._task_targets, strict=True
        ):
            task.update(dynamics, jacobian, target)
        lower[spans["task"]] = upper[spans["task"]] = self._task_scale * self._task_target
        np.subtract(-self._effort, bias[6:], out=lower[spans["torque"]])
        np.subtract(self._effort, bias[6:], out=upper[spans["torque"]])
        self.q[6 : self.nv] = -self.posture.weight * self.posture.target(dynamics)
        self._limit(dynamics, lower[spans["limit"]], upper[spans["limit"]])
        np.take(self._source, self._gather, out=self.A.data)
        self.A.data *= self._scale

    def _limit(self, dynamics: Dynamics, lower: Array, upper: Array) -> None:
        """Write the joint accelerations that keep positions and speeds within their limits."""
        robot, h = self.robot, LIMIT_HORIZON
        q, v = dynamics.q[7:], dynamics.v[6:]
        slowest, fastest = (-robot.v_limit - v) / h, (robot.v_limit - v) / h
        moved = q + h * v
        # A speed limit outranks a position limit, so that lower <= upper always holds.
        np.clip(2 / h**2 * (robot.q_lower - moved), slowest, fastest, out=lower)
        np.clip(2 / h**2 * (robot.q_upper - moved), slowest, fastest, out=upper)

    def torques(self, z: Array, dynamics: Dynamics) -> Array:
        """Return the joint torques (n,) in N·m of a solution z: the actuated rows of dynamics."""
        torque = self.A[self.spans["torque"]] @ z * TORQUE_UNIT
        result: Array = torque + dynamics.bias[6:]
        return result


def _related_dofs(model: pin.Model) -> np.ndarray:
    """Return where the mass matrix (nv, nv) can be non-zero: one joint supports the other."""
    owner = np.zeros(model.nv, dtype=int)
    for joint in range(1, model.njoints):
        owner[model.joints[joint].idx_v :][: model.joints[joint].nv] = joint
    above = np.zeros((model.njoints, model.njoints), dtype=bool)
    for joint in range(1, model.njoints):
        above[list(model.supports[joint]), joint] = True
    either = above | above.T
    return np.asarray(either[np.ix_(owner, owner)])


def _tip_dof(robot: Robot, foot: Foot) -> int:
    """Return the last degree of freedom of the leg that carries a sole."""
    joint = robot.pin.joints[robot.pin.frames[robot.soles[foot].frame].parentJoint]
    return int(joint.idx_v + joint.nv - 1)
