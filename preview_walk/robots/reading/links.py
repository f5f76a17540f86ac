"""The tree of links in a URDF: one root, one parent each, and nothing that runs in a circle."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from preview_walk.errors import RobotError
from preview_walk.robots.bounds import MOST_LINKS

Element = ElementTree.Element

_CARRYING = ("floating", "planar", "prismatic", "revolute", "continuous")


@dataclass(frozen=True, eq=False)
class Links:
    """The links of a URDF as a tree.

    Attributes:
        named: every link's element by name.
        below: the joints that hang on a link, each with its child.
        root: the link that floats.
        carrying: names of the joints that carry the root through its world, which are left out.
    """

    named: dict[str, Element]
    below: dict[str, list[tuple[Element, str]]]
    root: str
    carrying: tuple[str, ...]


def links_of(file: str, robot: Element) -> Links:
    """Return the tree of links in a URDF.

    Args:
        file: its name, for a sentence.
        robot: its root element.

    Raises:
        RobotError: the links do not make one tree.
    """
    elements, joints = robot.findall("link"), robot.findall("joint")
    if len(elements) > MOST_LINKS:
        raise RobotError(f"'{file}' has {len(elements)} links; at most {MOST_LINKS} are read")
    _once(file, "link", elements)
    _once(file, "joint", joints)
    named = {str(link.get("name")): link for link in elements}
    below: dict[str, list[tuple[Element, str]]] = {name: [] for name in named}
    above: dict[str, Element] = {}
    for joint in joints:
        parent, child = (_end(joint, end, named) for end in ("parent", "child"))
        if child in above:
            raise RobotError(
                f"the link '{child}' is the child of two joints, '{above[child].get('name')}' and "
                f"'{joint.get('name')}'; expected one"
            )
        above[child] = joint
        below[parent].append((joint, child))
    roots = [name for name in named if name not in above]
    if len(roots) != 1:
        raise RobotError(
            f"'{file}' has {len(roots)} root links"
            + (f" ({', '.join(roots)})" if roots else "")
            + "; expected one"
        )
    _refuse_circles(file, roots[0], below)
    root, carrying = _floating(roots[0], named, below)
    return Links(named, below, root, carrying)


def _once(file: str, kind: str, elements: Iterable[Element]) -> None:
    """Raise `RobotError` for a name that is missing or given twice."""
    names = Counter(element.get("name") or "" for element in elements)
    if names[""]:
        raise RobotError(f"'{file}' has a {kind} without a name; expected one for each")
    for name, count in names.items():
        if count > 1:
            raise RobotError(f"'{file}' has {count} {kind}s called '{name}'; expected one")


def _end(joint: Element, end: str, links: dict[str, Element]) -> str:
    """Return the link that a joint names as its parent or child."""
    element = joint.find(end)
    name = "" if element is None else str(element.get("link"))
    if name not in links:
        raise RobotError(
            f"the joint '{joint.get('name')}' names the {end} link '{name}', which the URDF lacks"
        )
    return name


def _refuse_circles(file: str, root: str, below: dict[str, list[tuple[Element, str]]]) -> None:
    """Raise `RobotError` for links to which no way leads from the root."""
    reached, waiting = {root}, [root]
    while waiting:
        children = [child for _, child in below[waiting.pop()]]
        reached.update(children)
        waiting += children
    circle = [name for name in below if name not in reached]
    if circle:
        raise RobotError(
            f"'{file}' has links that are their own ancestors ({', '.join(circle)}); "
            "expected a tree"
        )


def _floating(
    root: str, named: dict[str, Element], below: dict[str, list[tuple[Element, str]]]
) -> tuple[str, tuple[str, ...]]:
    """Return the link that floats, and the joints that carry it through its world.

    A link called world and links without mass, each on one joint, are such a world: the joints
    stand for the base's own six degrees of freedom.
    """
    carrying: list[str] = []
    while len(below[root]) == 1:
        joint, child = below[root][0]
        kind = joint.get("type")
        if root != "world" and (kind not in _CARRYING or _weighs(named[root])):
            break
        if kind in _CARRYING and kind != "floating":
            carrying.append(str(joint.get("name")))
        root = child
    return root, tuple(carrying)


def _weighs(link: Element) -> bool:
    """Return whether a link has a mass; one that is no number counts, to be told of later."""
    mass = link.find("inertial/mass")
    try:
        return mass is not None and float(mass.get("value", "0")) != 0.0
    except ValueError:
        return True
