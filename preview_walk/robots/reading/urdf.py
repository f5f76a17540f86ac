"""Read a URDF as a MuJoCo spec of links and joints; `shapes` adds its geometry."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.reading.inertia import usable_inertia
from preview_walk.types import Array

Element = ElementTree.Element

_KINDS = {
    "revolute": mujoco.mjtJoint.mjJNT_HINGE,
    "continuous": mujoco.mjtJoint.mjJNT_HINGE,
    "prismatic": mujoco.mjtJoint.mjJNT_SLIDE,
}


@dataclass(frozen=True, eq=False)
class UrdfFile:
    """A URDF's XML, and where its meshes are looked for.

    Attributes:
        path: the file.
        robot: its root element, <robot>.
    """

    path: Path
    robot: Element


@dataclass(eq=False)
class Urdf:
    """A URDF read: its spec and what a spec does not hold.

    Attributes:
        file: the XML.
        spec: links and joints without shapes, the root on a free joint.
        speed: speed limits (rad/s) by joint name.
        mimics: the joint that is followed, by the name of the one that follows.
        flaws: what was wrong with inertias, and the links concerned.
    """

    file: UrdfFile
    spec: mujoco.MjSpec
    speed: dict[str, float] = field(default_factory=dict)
    mimics: dict[str, str] = field(default_factory=dict)
    flaws: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))


def read_urdf(path: Path) -> Urdf:
    """Return a URDF's links and joints as a MuJoCo spec whose root hangs on a free joint.

    Args:
        path: the file.

    Raises:
        RobotError: a file that is not a URDF, or whose tree, joints or masses cannot be.
    """
    try:
        robot = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise RobotError(f"cannot read '{path}' as a URDF: {error}") from error
    if robot.tag != "robot":
        raise RobotError(f"'{path}' holds <{robot.tag}>; expected a URDF, whose root is <robot>")
    links = {str(link.get("name")): link for link in robot.findall("link")}
    below: dict[str, list[tuple[Element, str]]] = {name: [] for name in links}
    roots = dict.fromkeys(links)
    for joint in robot.findall("joint"):
        parent, child = (_end(joint, end, links) for end in ("parent", "child"))
        below[parent].append((joint, child))
        roots.pop(child, None)
    if len(roots) != 1:
        raise RobotError(
            f"'{path.name}' has {len(roots)} root links"
            + (f" ({', '.join(roots)})" if roots else "")
            + "; expected one"
        )
    root = next(iter(roots))
    while len(below[root]) == 1 and (
        root == "world" or below[root][0][0].get("type") == "floating"
    ):
        root = below[root][0][1]
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    read = Urdf(UrdfFile(path, robot), spec)
    base = spec.worldbody.add_body(name=root)
    base.add_freejoint(name="root")
    _inertia(read, base, links[root], moving=False)
    stack = [(base, item) for item in reversed(below[root])]
    while stack:
        above, (joint, child) = stack.pop()
        position, rotation = origin(joint)
        body = above.add_body(name=child, pos=position, quat=quaternion(rotation))
        _inertia(read, body, links[child], moving=_joint(read, body, joint))
        stack += [(body, item) for item in reversed(below[child])]
    return read


def _end(joint: Element, end: str, links: dict[str, Element]) -> str:
    """Return the link that a joint names as its parent or child."""
    element = joint.find(end)
    name = "" if element is None else str(element.get("link"))
    if name not in links:
        raise RobotError(
            f"the joint '{joint.get('name')}' names the {end} link '{name}', which the URDF lacks"
        )
    return name


def _joint(read: Urdf, body: mujoco.MjsBody, element: Element) -> bool:
    """Add a URDF joint to its child body; return whether it moves."""
    name, kind = str(element.get("name")), str(element.get("type"))
    if kind == "fixed":
        return False
    if kind not in _KINDS:
        raise RobotError(
            f"the joint '{name}' is of type '{kind}'; "
            "expected revolute, continuous, prismatic or fixed"
        )
    axis = vector(element.find("axis"), "xyz", (1.0, 0.0, 0.0))
    length = float(np.linalg.norm(axis))
    if not length > 1e-6:
        raise RobotError(f"the joint '{name}' has a zero axis; expected a direction")
    joint = body.add_joint(name=name, type=_KINDS[kind], axis=axis / length)
    limit, dynamics = element.find("limit"), element.find("dynamics")
    low, high = number(limit, "lower"), number(limit, "upper")
    if low > high:
        raise RobotError(
            f"the joint '{name}' has the lower limit {low:g} above the upper limit {high:g}"
        )
    if kind != "continuous" and low < high:
        joint.limited, joint.range = True, (low, high)
    effort = number(limit, "effort")
    if 0.0 < effort < np.inf:
        joint.actfrclimited, joint.actfrcrange = True, (-effort, effort)
    if number(limit, "velocity") > 0.0:
        read.speed[name] = number(limit, "velocity")
    joint.damping = (number(dynamics, "damping"), 0.0, 0.0)
    joint.frictionloss = number(dynamics, "friction")
    mimic = element.find("mimic")
    if mimic is not None:
        read.mimics[name] = str(mimic.get("joint"))
    return True


def _inertia(read: Urdf, body: mujoco.MjsBody, link: Element, moving: bool) -> None:
    """Give a body its link's mass and inertia."""
    inertial, name = link.find("inertial"), str(link.get("name"))
    mass, tensor, position, rotation = 0.0, np.zeros((3, 3)), np.zeros(3), np.eye(3)
    if inertial is not None:
        mass = number(inertial.find("mass"), "value")
        moments = inertial.find("inertia")
        xx, xy, xz, yy, yz, zz = (
            number(moments, key) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        tensor = np.array(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))
        position, rotation = origin(inertial)
    mass, principal, axes, flaw = usable_inertia(name, mass, tensor, moving)
    if flaw:
        read.flaws[flaw].append(name)
    body.explicitinertial = True
    body.mass, body.ipos, body.inertia = mass, position, principal
    body.iquat = quaternion(rotation @ axes)


def vector(element: Element | None, key: str, default: tuple[float, ...]) -> Array:
    """Return the numbers (n,) of an XML attribute; raises `RobotError` for another count."""
    text = element.get(key) if element is not None else None
    if text is None:
        return np.array(default)
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.empty(0)
    if len(values) != len(default):
        raise RobotError(f'the URDF holds {key}="{text}"; expected {len(default)} number(s)')
    return values


def number(element: Element | None, key: str) -> float:
    """Return the number of an XML attribute, 0 where it is missing."""
    return float(vector(element, key, (0.0,))[0])


def origin(element: Element) -> tuple[Array, Array]:
    """Return position (3,) and rotation (3, 3) of an element's <origin>."""
    at = element.find("origin")
    zero = (0.0, 0.0, 0.0)
    return vector(at, "xyz", zero), pin.rpy.rpyToMatrix(vector(at, "rpy", zero))


def quaternion(rotation: Array) -> Array:
    """Return the unit quaternion (w, x, y, z) of a rotation matrix (3, 3)."""
    out = np.empty(4)
    mujoco.mju_mat2Quat(out, np.ascontiguousarray(rotation).reshape(9))
    return out
