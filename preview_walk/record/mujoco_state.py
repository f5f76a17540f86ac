"""MuJoCo's state from a record's.

A record holds Pinocchio's conventions, as the controller does. MuJoCo's differ in the base alone:
its quaternion is w, x, y, z, and its linear velocity is in world axes.
"""

from __future__ import annotations

from preview_walk.errors import InvalidInput
from preview_walk.geometry.quaternions import rotate
from preview_walk.types import Array


def mujoco_qpos(q: Array) -> Array:
    """Return MuJoCo's configurations (N, nq) for those of a record.

    Raises:
        InvalidInput: the configurations have no floating base.
    """
    _require_base(q, 7, "q")
    qpos: Array = q.copy()
    qpos[:, 3], qpos[:, 4:7] = q[:, 6], q[:, 3:6]
    qpos.setflags(write=False)
    return qpos


def mujoco_qvel(q: Array, v: Array) -> Array:
    """Return MuJoCo's velocities (N, nv) for the configurations and velocities of a record.

    Raises:
        InvalidInput: the configurations or velocities have no floating base.
    """
    _require_base(q, 7, "q")
    _require_base(v, 6, "v")
    qvel: Array = v.copy()
    qvel[:, :3] = rotate(q[:, 3:7], v[:, :3])
    qvel.setflags(write=False)
    return qvel


def _require_base(array: Array, size: int, name: str) -> None:
    if array.shape[1] < size:
        raise InvalidInput(
            f"record field '{name}' must have {size} or more columns, the first of a floating "
            f"base, to give MuJoCo's state; got {array.shape[1]}.",
            argument=name,
        )
