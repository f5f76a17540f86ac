"""Read an MJCF file, and settle what a chain of hinges cannot express."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path

import mujoco
import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.inertia import MASSLESS, NO_MASS, usable_inertia

STANDING = ("stand", "standing", "home", "default", "init", "initial", "neutral", "half_sitting")
"""Names of keyframes whose arms and trunk the walking posture takes over."""

_Eq, _Trn = mujoco.mjtEq, mujoco.mjtTrn
_TENDON = int(_Trn.mjTRN_TENDON)
_SITE = int(mujoco.mjtObj.mjOBJ_SITE)


def compile_spec(spec: mujoco.MjSpec, source: str) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """Return a compiled spec and remarks; moving bodies without mass are given a little.

    Raises `RobotError` for masses that cannot be, else with MuJoCo's own words where it cannot be
    compiled.
    """
    for body in spec.bodies:
        if body.explicitinertial:
            inertia = np.diag(body.inertia)
            usable_inertia(body.name, float(body.mass), inertia, moving=False)
    light: list[str] = []
    while True:
        try:
            model = spec.compile()
        except (ValueError, RuntimeError) as error:
            named = re.search(
                r"moving bodies must be larger.*Element name '([^']+)'", str(error), re.S
            )
            body = spec.body(named.group(1)) if named else None
            if body is None or body.name in light:
                raise RobotError(f"MuJoCo cannot compile {source}: {_sentence(error)}") from error
            body.explicitinertial, body.fullinertia[0] = True, np.nan
            body.mass, body.inertia = max(float(body.mass), MASSLESS[0]), [MASSLESS[1]] * 3
            light.append(body.name)
        else:
            return model, ((f"{NO_MASS}: {', '.join(light)}",) if light else ())


def read_mjcf(path: Path) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """Return the compiled model of an MJCF file, and remarks.

    Raises `RobotError` where it cannot be read or compiled, mostly with MuJoCo's own words.
    """
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except (ValueError, RuntimeError) as error:
        raise RobotError(f"MuJoCo cannot read '{path}': {_sentence(error)}") from error
    return compile_spec(spec, f"'{path}'")


def _sentence(error: Exception) -> str:
    """Return an engine's message on one line."""
    return " ".join(str(error).removeprefix("Error: ").split())


def settle(
    tree: Tree, base: int, leg_joints: Collection[int], mimics: dict[str, str]
) -> tuple[set[int], list[str]]:
    """Return the joints (ids) to lock in place because another joint drives them, and remarks.

    `mimics` maps a URDF's following joints to those they follow. Couplings between joints lock the
    driven one; a coupling, a loop or a tendon that moves a leg is refused.

    Raises `RobotError` for a ball joint, for a free joint below the base, and for such couplings;
    it names the joint.
    """
    mj = tree.mj
    own = set(tree.below(base))
    _refuse_joints(tree, own)
    locked: dict[int, str] = {}
    notes: list[str] = []
    names = {tree.joint_name(j): j for j in range(mj.njnt)}
    for name, leader in mimics.items():
        locked[names[name]] = leader
    for equality in range(mj.neq):
        if not mj.eq_active0[equality]:
            continue
        first, second = int(mj.eq_obj1id[equality]), int(mj.eq_obj2id[equality])
        kind = int(mj.eq_type[equality])
        if kind == _Eq.mjEQ_JOINT:
            locked[first] = tree.joint_name(second) if second >= 0 else "a constant"
        elif kind in (_Eq.mjEQ_CONNECT, _Eq.mjEQ_WELD):
            ends = [_body_of(tree, int(mj.eq_objtype[equality]), end) for end in (first, second)]
            if own.issuperset(ends):
                raise RobotError(
                    f"the equality constraint '{_equality_name(mj, equality)}' closes a loop "
                    f"between the bodies '{tree.name(ends[0])}' and '{tree.name(ends[1])}'; "
                    "only open chains of joints are allowed"
                )
            if own.intersection(ends):
                name = _equality_name(mj, equality)
                notes.append(f"the constraint '{name}' to the scene is left out")
    for joint, leader in locked.items():
        if joint in leg_joints:
            raise RobotError(
                f"the leg joint '{tree.joint_name(joint)}' is driven by {_quoted(leader)}; "
                "every leg joint must move on its own"
            )
    for actuator in range(mj.nu):
        if int(mj.actuator_trntype[actuator]) == _TENDON:
            _refuse_leg_tendon(tree, int(mj.actuator_trnid[actuator, 0]), leg_joints)
    if locked:
        notes.append(
            "locked, because another joint drives them: "
            + ", ".join(tree.joint_name(joint) for joint in locked)
        )
    if mj.ntendon:
        notes.append(f"{mj.ntendon} tendon(s) left out")
    carried = tree.joints_on(tree.path(base))
    if carried:
        names_ = ", ".join(tree.joint_name(joint) for joint in carried)
        notes.append(f"joints between world and base became a free joint: {names_}")
    strangers = [
        tree.name(b)
        for b in range(1, mj.nbody)
        if b not in own | set(tree.path(base)) and mj.body_jntnum[b]
    ]
    if strangers:
        notes.append(f"not part of the robot, left out: {', '.join(strangers)}")
    return set(locked), notes


def keyframe_angles(tree: Tree) -> tuple[dict[str, float], str]:
    """Return the joint angles of the keyframe in which the robot stands, by joint name; its name.

    The one called stand, home, default or the like, else the only one; ({}, "") without it.
    """
    mj = tree.mj
    names = [str(mj.key(key).name) or f"key_{key}" for key in range(mj.nkey)]
    standing = [key for key, name in enumerate(names) if name.lower() in STANDING]
    standing += [0] if len(names) == 1 else []
    if not standing:
        return {}, ""
    key = standing[0]
    moving = tree.joints_on(list(range(1, mj.nbody)))
    angles = {tree.joint_name(j): float(mj.key_qpos[key, mj.jnt_qposadr[j]]) for j in moving}
    return angles, names[key]


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
                f"'{mj.tendon(tendon).name}'; expected a motor on every leg joint"
            )


def _body_of(tree: Tree, kind: int, id_: int) -> int:
    """Return the body of a constraint's end."""
    return int(tree.mj.site_bodyid[id_]) if kind == _SITE else id_


def _equality_name(mj: mujoco.MjModel, equality: int) -> str:
    return str(mj.equality(equality).name) or f"equality_{equality}"


def _quoted(leader: str) -> str:
    return leader if leader == "a constant" else f"'{leader}'"
