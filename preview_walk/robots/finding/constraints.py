"""What a chain of hinges cannot express: couplings, loops, tendons, and what holds the robot."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import mujoco

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree

_Eq = mujoco.mjtEq
_LOOPS = {int(_Eq.mjEQ_CONNECT): "connect", int(_Eq.mjEQ_WELD): "weld"}
_TENDON = int(mujoco.mjtTrn.mjTRN_TENDON)
_SITE = int(mujoco.mjtObj.mjOBJ_SITE)


def settle(
    tree: Tree, base: int, leg_joints: Collection[int], mimics: Mapping[str, str]
) -> tuple[set[int], list[str]]:
    """Return the joints (ids) to lock in place because another joint drives them, and remarks.

    Args:
        tree: the model.
        base: its floating body.
        leg_joints: the joints (ids) of both legs, which must move on their own.
        mimics: the joint that is followed, by the name of the one that follows.

    Raises:
        RobotError: a ball joint, or a coupling, a loop or a tendon that moves a leg; names it.
    """
    _refuse_joints(tree, set(tree.below(base)))
    _refuse_loops(tree, base)
    notes = [
        f"the scene holds the robot by {what}, which is left out here"
        for what in holding_constraints(tree, base)
    ]
    locked = _driven(tree, mimics)
    for joint, leader in locked.items():
        if joint in leg_joints:
            raise RobotError(
                f"the leg joint '{tree.joint_name(joint)}' is driven by {_quoted(leader)}; "
                "every leg joint must move on its own: leave the coupling out, and give the joint "
                "a motor"
            )
    for actuator in range(tree.mj.nu):
        if int(tree.mj.actuator_trntype[actuator]) == _TENDON:
            _refuse_leg_tendon(tree, int(tree.mj.actuator_trnid[actuator, 0]), leg_joints)
    if locked:
        notes.append(
            "locked, because another joint drives them: "
            + ", ".join(tree.joint_name(joint) for joint in locked)
        )
    return set(locked), [*notes, *_left_out(tree, base)]


def holding_constraints(tree: Tree, base: int) -> tuple[str, ...]:
    """Return the constraints that hold a robot to its scene, in words.

    Welds and connections that are active at the start and tie a body of the robot to one that is
    none of its own, as a crane does: a robot held so can neither fall nor walk.

    Args:
        tree: the scene.
        base: the robot's floating body.
    """
    own = set(tree.below(base))
    return tuple(
        f"the {kind} '{name}' between '{_name(tree, one)}' and '{_name(tree, two)}'"
        for kind, name, one, two in _ties(tree)
        if (one in own) != (two in own)
    )


def _ties(tree: Tree) -> Iterator[tuple[str, str, int, int]]:
    """Yield kind, name and the two bodies of every active weld and connection."""
    mj = tree.mj
    for equality in range(mj.neq):
        kind = _LOOPS.get(int(mj.eq_type[equality]))
        if kind is None or not mj.eq_active0[equality]:
            continue
        ends = int(mj.eq_obj1id[equality]), int(mj.eq_obj2id[equality])
        if int(mj.eq_objtype[equality]) == _SITE:
            ends = int(mj.site_bodyid[ends[0]]), int(mj.site_bodyid[ends[1]])
        yield kind, str(mj.equality(equality).name) or f"equality_{equality}", *ends


def _name(tree: Tree, body: int) -> str:
    """Return a body's name, that of the world included."""
    return tree.name(body) if body else "world"


def _refuse_loops(tree: Tree, base: int) -> None:
    """Raise `RobotError` for a weld or a connection between two bodies of the robot."""
    own = set(tree.below(base))
    for _, name, one, two in _ties(tree):
        if one in own and two in own:
            raise RobotError(
                f"the equality constraint '{name}' closes a loop between the bodies "
                f"'{tree.name(one)}' and '{tree.name(two)}'; expected open chains: leave the "
                "constraint out, and give the joints that it drives motors of their own"
            )


def _driven(tree: Tree, mimics: Mapping[str, str]) -> dict[int, str]:
    """Return what drives the joints (ids) that do not move on their own."""
    mj = tree.mj
    names = {tree.joint_name(j): j for j in range(mj.njnt)}
    driven = {names[name]: leader for name, leader in mimics.items()}
    for equality in range(mj.neq):
        if mj.eq_active0[equality] and int(mj.eq_type[equality]) == int(_Eq.mjEQ_JOINT):
            leader = int(mj.eq_obj2id[equality])
            driven[int(mj.eq_obj1id[equality])] = (
                tree.joint_name(leader) if leader >= 0 else "a constant"
            )
    return driven


def _left_out(tree: Tree, base: int) -> list[str]:
    """Return remarks on what the scene holds besides the robot's chain of joints."""
    mj, own = tree.mj, set(tree.below(base))
    notes = [f"{mj.ntendon} tendon(s) left out"] if mj.ntendon else []
    path = tree.path(base)
    carried = tree.joints_on(path)
    if carried:
        names = ", ".join(tree.joint_name(joint) for joint in carried)
        notes.append(f"joints between world and base became a free joint: {names}")
    strangers = [b for b in range(1, mj.nbody) if b not in own | set(path) and mj.body_jntnum[b]]
    if strangers:
        names = ", ".join(tree.name(body) for body in strangers)
        notes.append(f"not part of the robot, left out: {names}")
    return notes


def _refuse_joints(tree: Tree, own: set[int]) -> None:
    """Raise `RobotError` for a joint of the robot that is neither hinge nor slide."""
    mj = tree.mj
    for joint in range(mj.njnt):
        body = int(mj.jnt_bodyid[joint])
        if int(mj.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_BALL) and body in own:
            raise RobotError(
                f"the joint '{tree.joint_name(joint)}' is a ball joint, which is not supported; "
                "expected hinges in its place"
            )


def _refuse_leg_tendon(tree: Tree, tendon: int, leg_joints: Collection[int]) -> None:
    """Raise `RobotError` where a tendon with a motor pulls on a leg joint."""
    mj = tree.mj
    first = int(mj.tendon_adr[tendon])
    for wrap in range(first, first + int(mj.tendon_num[tendon])):
        joint = int(mj.wrap_objid[wrap])
        if int(mj.wrap_type[wrap]) == int(mujoco.mjtWrap.mjWRAP_JOINT) and joint in leg_joints:
            raise RobotError(
                f"the leg joint '{tree.joint_name(joint)}' is moved by the tendon "
                f"'{mj.tendon(tendon).name}'; expected a motor on the joint itself, with the "
                "torque that the tendon gives there"
            )


def _quoted(leader: str) -> str:
    """Return what drives a joint, to be read."""
    return leader if leader == "a constant" else f"'{leader}'"
