"""Find a humanoid in a kinematic tree: base, legs, left and right, up and forward, torso."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.finding.legs import find_pair, require_joints, without_toes
from preview_walk.robots.finding.tree import Tree, nearest_axis
from preview_walk.types import FEET, Array, Foot


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
    if feet:
        left, right = (_body(tree, feet[foot], f"the {foot} sole") for foot in FEET)
        pair = (left, right)
    else:
        pair = find_pair(tree)
    pelvis = tree.common(list(pair))
    base = _base(tree, pelvis)
    chains = [tree.joints_on(tree.path(tip)[len(tree.path(pelvis)) :]) for tip in pair]
    for tip, chain in zip(pair, chains, strict=True):
        require_joints(tree, tip, chain)
    if not feet:
        up, across = _directions(tree, base, chains)
        chains = [without_toes(tree, chain, up, across) for chain in chains]
        one, two = (int(tree.mj.jnt_bodyid[chain[-1]]) for chain in chains)
        pair = (one, two)
    up, across = _directions(tree, base, chains)
    notes: list[str] = []
    if not feet:
        side = _side(tree, pair, chains)
        if side == 0:
            side = _bending_side(tree, chains, across, up)
            notes.append("no name tells left from right: taken from the way the knees bend")
        if side < 0:
            pair, chains, across = (pair[1], pair[0]), chains[::-1], -across
    forward = np.cross(across, up)
    if forward @ tree.rotation(base)[:, 0] < 0.9:
        notes.append(f"forward is ({_rounded(forward @ tree.rotation(base))}) in the base's axes")
    found: dict[Foot, int] = dict(zip(FEET, pair, strict=True))
    legs: dict[Foot, tuple[int, ...]] = dict(zip(FEET, map(tuple, chains), strict=True))
    trunk = _torso(tree, base, pelvis, found) if torso is None else _body(tree, torso, "the torso")
    for foot, leg in legs.items():
        if trunk in tree.below(int(tree.mj.jnt_bodyid[leg[0]])):
            raise RobotError(
                f"the torso names the body '{tree.name(trunk)}', which is a part of the {foot} "
                "leg; expected the trunk"
            )
    return Structure(base, found, legs, up, forward, trunk, tuple(notes))


def _directions(tree: Tree, base: int, chains: list[list[int]]) -> tuple[Array, Array]:
    """Return up (3,) and the direction (3,) from the second leg across to the first."""
    hips, ends = ([tree.anchor(chain[i]) for chain in chains] for i in (0, -1))
    up = _up(tree, base, hips[0] + hips[1] - ends[0] - ends[1])
    across = hips[0] - hips[1]
    if np.linalg.norm(across) < 0.01:
        across = ends[0] - ends[1]
    across = across - up * (up @ across)
    return up, nearest_axis(across / np.linalg.norm(across), tree.rotation(base), np.radians(20))


def _body(tree: Tree, name: str, what: str) -> int:
    """Return the id of a named body; raises `RobotError` for an unknown name."""
    for body in range(1, tree.mj.nbody):
        if tree.name(body) == name:
            return body
    raise RobotError(
        f"{what} names the body '{name}', which the model lacks; "
        f"it has {', '.join(tree.name(body) for body in range(1, tree.mj.nbody))}"
    )


def _rounded(vector: Array) -> str:
    """Return a vector to be read, without rounding errors and negative zeros."""
    return ", ".join(f"{x:.2g}" for x in np.round(vector, 6) + 0.0)


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
        axes = [tree.axis(joint) for joint in chain]
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
