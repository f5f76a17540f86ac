"""The one converter between MuJoCo's and Pinocchio's conventions of state.

| | MuJoCo | Pinocchio |
|---|---|---|
| base quaternion | w, x, y, z | x, y, z, w |
| base linear velocity | world axes | base axes |
| base angular velocity | base axes | base axes |

Joints follow the base in the same order in both.
"""

from __future__ import annotations

import numpy as np

from preview_walk.types import Array


def rotation_from_xyzw(x: float, y: float, z: float, w: float) -> Array:
    """Return the rotation matrix (3, 3) of a unit quaternion."""
    return np.array(
        (
            (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
        )
    )


def to_pinocchio(qpos: Array, qvel: Array, q: Array, v: Array) -> None:
    """Write Pinocchio's (q, v) for MuJoCo's (qpos, qvel), both of a robot with a floating base.

    `qpos`, `q` are (nq,), `qvel`, `v` are (nv,); `q` and `v` are filled in place.
    """
    q[:] = qpos
    w, x, y, z = qpos[3:7].tolist()
    norm = 1.0 / (w * w + x * x + y * y + z * z) ** 0.5
    w, x, y, z = w * norm, x * norm, y * norm, z * norm
    q[3], q[4], q[5], q[6] = x, y, z, w
    v[:] = qvel
    v[:3] = qvel[:3] @ rotation_from_xyzw(x, y, z, w)


def to_mujoco(q: Array, v: Array, qpos: Array, qvel: Array) -> None:
    """Write MuJoCo's (qpos, qvel) for Pinocchio's (q, v): the inverse of `to_pinocchio`."""
    qpos[:] = q
    x, y, z, w = q[3:7].tolist()
    qpos[3], qpos[4], qpos[5], qpos[6] = w, x, y, z
    qvel[:] = v
    qvel[:3] = rotation_from_xyzw(x, y, z, w) @ v[:3]
