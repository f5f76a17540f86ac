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
from preview_walk.robots.bounds import LARGEST
from preview_walk.robots.reading.content import content_of
from preview_walk.robots.reading.inertia import usable_inertia
from preview_walk.robots.reading.links import Element, links_of
from preview_walk.types import Array

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
        carrying: joints that carry the base through its world, left out.
    """

    file: UrdfFile
    spec: mujoco.MjSpec
    speed: dict[str, float] = field(default_factory=dict)
    mimics: dict[str, str] = field(default_factory=dict)
    flaws: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))
    carrying: tuple[str, ...] = ()


def read_urdf(path: Path) -> Urdf:
    """Return a URDF's links and joints as a MuJoCo spec whose root hangs on a free joint.

    Args:
        path: the file.

    Raises:
        RobotError: a file that is not a URDF, or whose tree, joints or masses cannot be.
    """
    try:
        robot = ElementTree.fromstring(content_of(path))
    except (ElementTree.ParseError, LookupError, ValueError, RecursionError) as error:
        raise RobotError(f"cannot read '{path}' as a URDF: {error}") from error
    if robot.tag != "robot":
        raise RobotError(f"'{path}' holds <{robot.tag}>; expected a URDF, whose root is <robot>")
    links = links_of(path.name, robot)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    read = Urdf(UrdfFile(path, robot), spec, carrying=links.carrying)
    base = spec.worldbody.add_body(name=links.root)
    base.add_freejoint(name="root")
    _inertia(read, base, links.named[links.root], moving=False)
    stack = [(base, item) for item in reversed(links.below[links.root])]
    while stack:
        above, (joint, child) = stack.pop()
        position, rotation = origin(joint)
        body = above.add_body(name=child, pos=position, quat=quaternion(rotation))
        _inertia(read, body, links.named[child], moving=_joint(read, body, joint))
        stack += [(body, item) for item in reversed(links.below[child])]
    return read


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
    if kind != "continuous" and low != high:
        joint.limited, joint.range = True, (low, high)
    effort = number(limit, "effort")
    if not effort <= 0.0 and effort != np.inf:  # NaN goes on, to be told of
        joint.actfrclimited, joint.actfrcrange = True, (-effort, effort)
    speed = number(limit, "velocity")
    if not speed <= 0.0:
        read.speed[name] = speed
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
    rpy = vector(at, "rpy", zero)
    if not (np.abs(rpy) <= LARGEST).all():
        text = ", ".join(f"{angle:g}" for angle in rpy)
        raise RobotError(f"the URDF holds the angles ({text}) rad; expected up to {LARGEST:g}")
    return vector(at, "xyz", zero), pin.rpy.rpyToMatrix(rpy)


def quaternion(rotation: Array) -> Array:
    """Return the unit quaternion (w, x, y, z) of a rotation matrix (3, 3)."""
    out = np.empty(4)
    mujoco.mju_mat2Quat(out, np.ascontiguousarray(rotation).reshape(9))
    return out
