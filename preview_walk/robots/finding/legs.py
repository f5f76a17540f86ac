"""Find the two legs of a humanoid in a kinematic tree, and where they end."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree
from preview_walk.types import Array

LEG_JOINTS = 5
"""Joints that a leg needs at least: with six the sole can be placed freely, with five it can but
in one direction of rotation, in which it then follows the rest of the robot."""

TOE_AHEAD = 0.03
"""A toe's axis lies at least this far from the ankle, as a share of the leg."""


def find_pair(tree: Tree) -> tuple[int, int]:
    """Return the tips of the two limbs that reach furthest in one direction, preferably down."""
    reach: dict[tuple[tuple[int, int], int], float] = {}
    places = {tip: tree.position(tip) for tip in tree.tips}
    for pair in combinations(tree.tips, 2):
        trunk = tree.common(list(pair))
        counts = [len(tree.joints_on(tree.path(tip)[len(tree.path(trunk)) :])) for tip in pair]
        if not trunk or min(counts) < LEG_JOINTS or abs(counts[0] - counts[1]) > 1:
            continue
        turn = tree.rotation(tree.path(trunk)[0])
        axes = np.column_stack(((0.0, 0.0, -1.0), turn, -turn))  # down first
        start = tree.position(trunk)
        furthest = ((np.array(list(places.values())) - start) @ axes).max(axis=0)
        ahead = ((np.array([places[tip] for tip in pair]) - start) @ axes).min(axis=0)
        for axis in np.flatnonzero(ahead > 0.5 * furthest):  # no third limb reaches much further
            reach[pair, int(axis)] = float(ahead[axis])
    if not reach and _on_the_world(tree):
        raise RobotError(
            "the limbs hang on the world: the robot has no base body (MuJoCo fuses a URDF's root "
            "link into the world); expected a base with a mass, or the .urdf file itself"
        )
    if not reach:
        limbs = ", ".join(f"'{tree.name(tip)}' ({_own(tree, tip)} joints)" for tip in tree.tips)
        raise RobotError(
            f"no two legs found: expected two limbs of at least {LEG_JOINTS} joints, the lowest "
            f"of the robot, on one body; its limbs end at {limbs or 'no joint at all'}"
        )
    best = max(reach, key=lambda key: reach[key])
    standing = [key for key in reach if key[1] == 0 and reach[key] > 0.6 * reach[best]]
    return max(standing, key=lambda key: reach[key], default=best)[0]


def _on_the_world(tree: Tree) -> bool:
    """Return whether two limbs long enough to be legs hang on the world, not on a base."""
    return any(
        tree.common(list(pair)) == 0
        and all(len(tree.joints_on(tree.path(tip))) >= LEG_JOINTS for tip in pair)
        for pair in combinations(tree.tips, 2)
    )


def _own(tree: Tree, tip: int) -> int:
    """Return how many joints a limb has from where it leaves the others to its tip."""
    trunks = [len(tree.path(tree.common([tip, end]))) for end in tree.tips if end != tip]
    return len(tree.joints_on(tree.path(tip)[max(trunks, default=0) :]))


def require_joints(tree: Tree, tip: int, chain: list[int]) -> None:
    """Raise `RobotError` for a leg of too few joints."""
    if len(chain) < LEG_JOINTS:
        names = ", ".join(tree.joint_name(joint) for joint in chain)
        raise RobotError(
            f"the leg to '{tree.name(tip)}' has {len(chain)} joints"
            + (f" ({names})" if names else "")
            + f"; expected at least {LEG_JOINTS}: hip, knee and ankle that place the sole"
        )


def without_toes(tree: Tree, chain: list[int], up: Array, across: Array) -> list[int]:
    """Return a leg's joints without those of its toes.

    A toe bends about a lateral axis that lies ahead of the ankle rather than below it, and leaves
    a hip, a knee and an ankle behind it.
    """
    chain = list(chain)
    length = float(np.linalg.norm(tree.anchor(chain[0]) - tree.anchor(chain[-1])))
    lateral = [abs(float(tree.axis(joint) @ across)) > 0.7 for joint in chain]
    while len(chain) > LEG_JOINTS and lateral[len(chain) - 1] and sum(lateral[: len(chain)]) > 3:
        way = tree.anchor(chain[-1]) - tree.anchor(chain[-2])
        down = float(up @ way)
        ahead = float(np.linalg.norm(way - down * up))
        if ahead < max(TOE_AHEAD * length, -down):
            break
        chain.pop()
    return chain
