"""Find a humanoid in a kinematic tree: base, legs, left and right, up and forward, torso."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree, nearest_axis
from preview_walk.types import FEET, Array, Foot

LEG_JOINTS = 6
"""Joints that a leg needs to place its sole freely."""


@dataclass(frozen=True, eq=False)
class Structure:
    """What stands for what in a model (MuJoCo body and joint ids), at its reference pose.

    Attributes:
        base: the body that floats.
        feet: the body of each foot.
        legs: the joints of each leg, from the pelvis to the foot.
        up: unit vector (3,) in world axes.
        forward: unit vector (3,) in world axes.
        torso: the body that is kept upright.
        notes: remarks, one sentence each.
    """

    base: int
    feet: Mapping[Foot, int]
    legs: Mapping[Foot, tuple[int, ...]]
    up: Array
    forward: Array
    torso: int
    notes: tuple[str, ...]


def find_structure(tree: Tree, feet: Mapping[Foot, str], torso: str | None) -> Structure:
    """Return a model's structure.

    Args:
        tree: the model.
        feet: names of the feet's bodies; empty to find them.
        torso: name of the trunk's body; None to find it.

    Raises:
        RobotError: an unknown body, or no two legs.
    """
    notes: list[str] = []
    if feet:
        found = {foot: _body(tree, name, f"the {foot} sole") for foot, name in feet.items()}
        pair = (found["left"], found["right"])
    else:
        pair = _find_pair(tree)
        found = {}
    pelvis = tree.common(list(pair))
    chains = [tree.joints_on(tree.path(tip)[len(tree.path(pelvis)) :]) for tip in pair]
    for tip, chain in zip(pair, chains, strict=True):
        if len(chain) < LEG_JOINTS:
            names = ", ".join(tree.joint_name(joint) for joint in chain)
            raise RobotError(
                f"the leg to '{tree.name(tip)}' has {len(chain)} joints"
                + (f" ({names})" if names else "")
                + f"; expected at least {LEG_JOINTS}, so that the sole can be placed freely"
            )
    if not feet:  # toes lie beyond the sixth joint
        chains = [chain[:LEG_JOINTS] for chain in chains]
        left, right = (int(tree.mj.jnt_bodyid[chain[-1]]) for chain in chains)
        pair = (left, right)
    base = _base(tree, pelvis)
    hips, soles = ([_at(tree, chain[i]) for chain in chains] for i in (0, LEG_JOINTS - 1))
    up = _up(tree, base, hips[0] + hips[1] - soles[0] - soles[1])
    across = hips[0] - hips[1]
    if np.linalg.norm(across) < 0.01:
        across = soles[0] - soles[1]
    across = across - up * (up @ across)
    across = nearest_axis(across / np.linalg.norm(across), tree.rotation(base), np.radians(20))
    if not feet:
        side = _side(tree, pair, chains)
        if side == 0:
            side = _bending_side(tree, chains, across, up)
            notes.append("no name tells left from right: taken from the way the knees bend")
        if side < 0:
            pair, chains, across = (pair[1], pair[0]), chains[::-1], -across
        found = dict(zip(FEET, pair, strict=True))
    forward = np.cross(across, up)
    if forward @ tree.rotation(base)[:, 0] < 0.9:
        notes.append(f"forward is ({_rounded(forward @ tree.rotation(base))}) in the base's axes")
    legs: dict[Foot, tuple[int, ...]] = dict(zip(FEET, map(tuple, chains), strict=True))
    trunk = _torso(tree, base, pelvis, found) if torso is None else _body(tree, torso, "the torso")
    return Structure(base, found, legs, up, forward, trunk, tuple(notes))


def _body(tree: Tree, name: str, what: str) -> int:
    """Return the id of a named body; raises `RobotError` for an unknown name."""
    for body in range(1, tree.mj.nbody):
        if tree.name(body) == name:
            return body
    raise RobotError(
        f"{what} names the body '{name}', which the model lacks; "
        f"it has {', '.join(tree.name(body) for body in range(1, tree.mj.nbody))}"
    )


def _at(tree: Tree, joint: int) -> Array:
    """Return the anchor (3,) of a joint in the world."""
    body = int(tree.mj.jnt_bodyid[joint])
    return np.asarray(tree.position(body) + tree.rotation(body) @ tree.mj.jnt_pos[joint])


def _find_pair(tree: Tree) -> tuple[int, int]:
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
    if not reach and tree.tips and tree.common(tree.tips) == 0:
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


def _rounded(vector: Array) -> str:
    """Return a vector to be read, without rounding errors and negative zeros."""
    return ", ".join(f"{x:.2g}" for x in np.round(vector, 6) + 0.0)


def _own(tree: Tree, tip: int) -> int:
    """Return how many joints a limb has from where it leaves the others to its tip."""
    trunks = [len(tree.path(tree.common([tip, end]))) for end in tree.tips if end != tip]
    return len(tree.joints_on(tree.path(tip)[max(trunks, default=0) :]))


def _base(tree: Tree, pelvis: int) -> int:
    """Return the body that floats: with a free joint, else the first that weighs something."""
    path = tree.path(pelvis)
    for body in path:
        first = int(tree.mj.body_jntadr[body])
        if tree.mj.body_jntnum[body] and int(tree.mj.jnt_type[first]) == 0:
            return body
    # Frames and chains of slides that carry a robot through its world weigh next to nothing.
    light = 1e-3 * float(tree.mj.body_subtreemass[path[0]])
    for body in path:
        if tree.mj.body_mass[body] > light:
            return body
    return pelvis


def _up(tree: Tree, base: int, stretch: Array) -> Array:
    """Return the upward direction (3,): the world's, or the base's axis along the legs."""
    upward = np.array((0.0, 0.0, 1.0))
    stretch = stretch / np.linalg.norm(stretch)
    if float(upward @ stretch) > np.cos(np.radians(45)):
        return upward
    return nearest_axis(stretch, tree.rotation(base), np.radians(45))


def _side(tree: Tree, pair: tuple[int, ...], chains: list[list[int]]) -> int:
    """Return 1 where names call the first leg left, -1 where right, 0 where they do not tell."""
    names = [
        [tree.name(tip)]
        + [tree.joint_name(j) for j in chain]
        + [tree.name(int(tree.mj.jnt_bodyid[j])) for j in chain]
        for tip, chain in zip(pair, chains, strict=True)
    ]
    votes = 0
    for one, two in zip(*names, strict=False):
        letters = zip(one.lower(), two.lower(), strict=False)
        differing = next((pair for pair in letters if pair[0] != pair[1]), None)
        votes += (differing == ("l", "r")) - (differing == ("r", "l"))
    return int(np.sign(votes))


def _bending_side(tree: Tree, chains: list[list[int]], across: Array, up: Array) -> int:
    """Return 1 if `across` points left, judged by knees, which swing the shank backward."""
    turn = 0.0
    for chain in chains:
        axes = [tree.rotation(int(tree.mj.jnt_bodyid[j])) @ tree.mj.jnt_axis[j] for j in chain]
        knees = [j for j, axis in zip(chain, axes, strict=True) if abs(axis @ across) > 0.8]
        if len(knees) > 1:
            knee = knees[1]
            axis = axes[chain.index(knee)]
            turn += float(tree.mj.jnt_range[knee].sum() * np.sign(axis @ across))
    return 1 if turn >= 0.0 else -1


def _torso(tree: Tree, base: int, pelvis: int, feet: Mapping[Foot, int]) -> int:
    """Return the body that carries arms and head: where the limbs that are not legs branch."""
    legs = {body for foot in FEET for body in tree.path(feet[foot])[len(tree.path(pelvis)) :]}
    carried = set(tree.below(base))
    tips = [tip for tip in tree.tips if tip in carried and not legs & set(tree.path(tip))]
    if not tips:
        return pelvis
    if len(tips) > 1:
        return tree.common(tips)
    path = tree.path(tips[0])
    return max(path[path.index(base) :], key=lambda body: float(tree.mj.body_mass[body]))
