"""The one converter between MuJoCo's and Pinocchio's conventions of state.

| | MuJoCo | Pinocchio |
|---|---|---|
| base quaternion | w, x, y, z | x, y, z, w |
| base linear velocity | world axes | base axes |
| base angular velocity | base axes | base axes |

Joints follow the base in the same order in both.
"""

from __future__ import annotations

import pinocchio as pin

from preview_walk.types import Array


def to_pinocchio(qpos: Array, qvel: Array, q: Array, v: Array) -> None:
    """Write Pinocchio's state for MuJoCo's, both of a robot with a floating base.

    Args:
        qpos: MuJoCo's configuration (nq,).
        qvel: MuJoCo's velocity (nv,).
        q: Pinocchio's configuration (nq,), filled in place.
        v: Pinocchio's velocity (nv,), filled in place.
    """
    q[:] = qpos
    w, x, y, z = qpos[3:7].tolist()
    length = (w * w + x * x + y * y + z * z) ** 0.5
    norm = 1.0 / length if length else 0.0  # zeros stay zeros: no orientation
    w, x, y, z = w * norm, x * norm, y * norm, z * norm
    q[3], q[4], q[5], q[6] = x, y, z, w
    v[:] = qvel
    v[:3] = qvel[:3] @ pin.Quaternion(w, x, y, z).toRotationMatrix()


def to_mujoco(q: Array, v: Array, qpos: Array, qvel: Array) -> None:
    """Write MuJoCo's state for Pinocchio's: the inverse of `to_pinocchio`.

    Args:
        q: Pinocchio's configuration (nq,).
        v: Pinocchio's velocity (nv,).
        qpos: MuJoCo's configuration (nq,), filled in place.
        qvel: MuJoCo's velocity (nv,), filled in place.
    """
    qpos[:] = q
    x, y, z, w = q[3:7].tolist()
    qpos[3], qpos[4], qpos[5], qpos[6] = w, x, y, z
    qvel[:] = v
    qvel[:3] = pin.Quaternion(w, x, y, z).toRotationMatrix() @ v[:3]
