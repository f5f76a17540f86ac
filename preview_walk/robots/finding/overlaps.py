"""Which of a robot's own shapes push each other apart where it stands."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco

from preview_walk.robots.finding.tree import Tree

DEEP = 1e-4
"""Shapes overlap (m) that lie deeper in each other than a contact at rest does."""


def overlaps(tree: Tree, base: int, angles: Mapping[str, float]) -> tuple[str, ...]:
    """Return the pairs of bodies whose shapes overlap in a posture, in words, with the depth.

    Only shapes count that MuJoCo lets touch: those of neighbours along a limb, and pairs that the
    file excludes, do not. In the robot's own scene what overlaps pushes, and the robot trembles.

    Args:
        tree: the model, with its shapes.
        base: the robot's floating body.
        angles: where its joints stand (rad, m), by name.
    """
    mj, own = tree.mj, set(tree.below(base))
    data = mujoco.MjData(mj)
    for joint in tree.joints_on(sorted(own)):
        name = tree.joint_name(joint)
        if name in angles:
            data.qpos[mj.jnt_qposadr[joint]] = angles[name]
    mujoco.mj_kinematics(mj, data)
    mujoco.mj_comPos(mj, data)
    mujoco.mj_collision(mj, data)
    deepest: dict[tuple[int, int], float] = {}
    for contact in data.contact:
        one, two = sorted(int(mj.geom_bodyid[geom]) for geom in contact.geom)
        if one in own and two in own and contact.dist < -DEEP:
            deepest[one, two] = max(deepest.get((one, two), 0.0), -float(contact.dist))
    return tuple(
        f"'{tree.name(one)}' and '{tree.name(two)}' by {1e3 * depth:.1f} mm"
        for (one, two), depth in sorted(deepest.items())
    )
