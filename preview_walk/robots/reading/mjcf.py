"""Read and compile an MJCF file."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import mujoco
import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.content import content_of, is_there, refuse_endless
from preview_walk.robots.reading.inertia import MASSLESS, NO_MASS, usable_inertia
from preview_walk.robots.reading.lost_looks import without_lost_looks

STANDING = ("stand", "standing", "home", "default", "init", "initial", "neutral", "half_sitting")
"""Names of keyframes whose arms and trunk the walking posture takes over."""


def compile_spec(spec: mujoco.MjSpec, source: str) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """Return a compiled spec and remarks.

    Moving bodies without mass are given a little; files that are only looked at and are missing
    are left out. The spec is changed.

    Args:
        spec: the model.
        source: what to call it in a sentence.

    Raises:
        RobotError: masses that cannot be, else MuJoCo's own words where it cannot be compiled.
    """
    notes = without_lost_looks(spec)
    for body in spec.bodies:
        if body.explicitinertial:
            inertia = np.diag(body.inertia)
            usable_inertia(body.name, float(body.mass), inertia, moving=False)
    light: list[str] = []
    while True:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of numbers that are checked and told of later
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
            return model, (*notes, *([f"{NO_MASS}: {', '.join(light)}"] if light else []))


def read_mjcf(path: Path) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """Return the compiled model of an MJCF file, and remarks.

    Args:
        path: the file, whatever its suffix.

    Raises:
        RobotError: it cannot be read or compiled; mostly with MuJoCo's own words.
    """
    content = content_of(path)
    refuse_endless(path, content)
    # MuJoCo looks at the suffix, so the content is handed over as that of a file called .xml.
    name = path.with_suffix(".xml")
    try:
        spec = mujoco.MjSpec.from_file(str(name), include={name.name: content})
    except (ValueError, RuntimeError) as error:
        hint = _scene_hint(path)
        raise RobotError(f"MuJoCo cannot read '{path}': {_sentence(error)}{hint}") from error
    try:
        return compile_spec(spec, f"'{path}'")
    except RobotError as error:
        raise RobotError(f"{error}{_scene_hint(path)}") from error


def _scene_hint(path: Path) -> str:
    """Return which file beside this one includes it: a part of a scene may need the whole."""
    named = re.compile(rb"<include\b[^>]*\bfile\s*=\s*[\"']" + re.escape(path.name.encode()))
    for scene in sorted(path.parent.glob("*.xml"))[:200]:
        if scene.name != path.name and is_there(scene) and named.search(content_of(scene)):
            return f"; it is a part of '{scene.name}', which lies beside it: give that file"
    return ""


def _sentence(error: Exception) -> str:
    """Return an engine's message on one line."""
    return " ".join(str(error).removeprefix("Error: ").split())


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
