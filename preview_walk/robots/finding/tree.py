"""Questions about the kinematic tree of a compiled MuJoCo model in its reference pose."""

from __future__ import annotations

from functools import cached_property

import mujoco
import numpy as np

from preview_walk.types import Array

MOVING = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
"""Joint types that a limb may have."""


class Tree:
    """A compiled model in its reference pose (`qpos0`): paths, joint chains and placements.

    World axes; bodies and joints are MuJoCo's ids.

    Attributes:
        mj: the model.
        data: its state in the reference pose, placements only.
    """

    def __init__(self, mj: mujoco.MjModel) -> None:
        self.mj = mj
        self.data = mujoco.MjData(mj)
        mujoco.mj_kinematics(mj, self.data)

    def __reduce__(self) -> tuple[type[Tree], tuple[mujoco.MjModel]]:
        """Pickle the model; the rest follows from it."""
        return type(self), (self.mj,)

    def __repr__(self) -> str:
        """Say it in one line."""
        return f"<Tree of {self.mj.nbody - 1} bodies and {self.mj.njnt} joints>"

    def name(self, body: int) -> str:
        """Return a body's name, "body_ID" where it has none."""
        return str(self.mj.body(body).name) or f"body_{body}"

    def joint_name(self, joint: int) -> str:
        """Return a joint's name, "joint_ID" where it has none."""
        return str(self.mj.joint(joint).name) or f"joint_{joint}"

    def position(self, body: int) -> Array:
        """Return a body's position (3,)."""
        return np.array(self.data.xpos[body])

    def rotation(self, body: int) -> Array:
        """Return a body's rotation (3, 3)."""
        return np.array(self.data.xmat[body]).reshape(3, 3)

    def anchor(self, joint: int) -> Array:
        """Return the anchor (3,) of a joint."""
        body = int(self.mj.jnt_bodyid[joint])
        return np.asarray(self.position(body) + self.rotation(body) @ self.mj.jnt_pos[joint])

    def axis(self, joint: int) -> Array:
        """Return the axis (3,) of a joint."""
        return np.asarray(self.rotation(int(self.mj.jnt_bodyid[joint])) @ self.mj.jnt_axis[joint])

    def path(self, body: int) -> list[int]:
        """Return the bodies from below the world to a body, both inclusive."""
        path = []
        while body:
            path.append(body)
            body = int(self.mj.body_parentid[body])
        return path[::-1]

    def joints_on(self, bodies: list[int]) -> list[int]:
        """Return the hinges and slides of the bodies of a path, in order."""
        return [
            joint
            for body in bodies
            for joint in range(
                int(self.mj.body_jntadr[body]),
                int(self.mj.body_jntadr[body] + self.mj.body_jntnum[body]),
            )
            if int(self.mj.jnt_type[joint]) in MOVING
        ]

    def common(self, bodies: list[int]) -> int:
        """Return the lowest body that carries all the bodies, 0 (the world) if there is none."""
        paths = [self.path(body) for body in bodies]
        shared = 0
        for level in zip(*paths, strict=False):
            if len(set(level)) > 1:
                break
            shared = level[0]
        return shared

    @cached_property
    def tips(self) -> list[int]:
        """The last jointed body of every limb: no joint hangs below it."""
        mj = self.mj
        carries = [False] * mj.nbody
        for body in range(mj.nbody - 1, 0, -1):
            if carries[body] or self.joints_on([body]):
                carries[mj.body_parentid[body]] = True
        return [b for b in range(1, mj.nbody) if self.joints_on([b]) and not carries[b]]

    def rigid_part(self, body: int) -> list[int]:
        """Return a body and all that is fixed to it, below it."""
        part = {body}
        for child in range(body + 1, self.mj.nbody):
            if int(self.mj.body_parentid[child]) in part and not self.mj.body_jntnum[child]:
                part.add(child)
        return sorted(part)

    def below(self, body: int) -> list[int]:
        """Return a body and all its descendants, parents first."""
        part = {body}
        for child in range(body + 1, self.mj.nbody):
            if int(self.mj.body_parentid[child]) in part:
                part.add(child)
        return sorted(part)


def nearest_axis(direction: Array, rotation: Array, within: float) -> Array:
    """Return the signed axis (3,) of a rotation nearest to a direction, in world axes.

    Args:
        direction: unit vector (3,) in world axes.
        rotation: (3, 3), whose columns are the axes.
        within: largest angle (rad) between the two; the direction itself comes back beyond it.
    """
    along = direction @ rotation
    index = int(np.argmax(np.abs(along)))
    axis = np.asarray(np.sign(along[index]) * rotation[:, index])
    return axis if float(axis @ direction) > np.cos(within) else direction
