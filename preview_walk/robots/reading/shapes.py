"""Put the visual or collision shapes of a URDF on the bodies of a spec."""

from __future__ import annotations

from collections.abc import Collection

import mujoco
import numpy as np

from preview_walk.errors import RobotError
from preview_walk.robots.bounds import LARGEST
from preview_walk.robots.reading.links import Element
from preview_walk.robots.reading.meshes import GREY, add_piece, mesh_file, read_mesh
from preview_walk.robots.reading.urdf import UrdfFile, number, origin, quaternion, vector
from preview_walk.types import Array

BONE = 0.025
"""Radius (m) of the bones that stand for missing shapes."""

VISUAL_GROUP = 2
"""MuJoCo geom group of what is only looked at."""


_KINDS = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
}


def add_shapes(
    urdf: UrdfFile, spec: mujoco.MjSpec, kind: str, links: Collection[str] | None = None
) -> list[str]:
    """Add the shapes of some or all links to the bodies of a spec.

    They touch nothing and weigh nothing.

    Args:
        urdf: the file.
        spec: its bodies, changed in place.
        kind: "visual" or "collision".
        links: names of the links whose shapes are added; None for all.

    Returns:
        The addresses of meshes that are missing or that could not be read.
    """
    materials = {
        str(material.get("name")): rgba
        for material in urdf.robot.iter("material")
        if (rgba := _rgba(material)) is not None
    }
    missing: list[str] = []
    for link in urdf.robot.findall("link"):
        body = spec.body(str(link.get("name")))
        if body is None or (links is not None and body.name not in links):
            continue
        for element in link.findall(kind):
            material = element.find("material")
            colour = None
            if material is not None:
                colour = _rgba(material) or materials.get(str(material.get("name")))
            lost = _add_shape(urdf, spec, body, element, colour)
            if lost is not None:
                missing.append(lost)
    return missing


def _add_shape(
    urdf: UrdfFile,
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    element: Element,
    colour: tuple[float, ...] | None,
) -> str | None:
    """Add one visual or collision element to a body; return the mesh that is missing, if one is."""
    geometry = element.find("geometry")
    shape = next(iter(geometry), None) if geometry is not None else None
    if shape is None:
        return None
    position, rotation = origin(element)
    quat = quaternion(rotation)
    if shape.tag == "mesh":
        filename = str(shape.get("filename"))
        file = mesh_file(filename, urdf.path)
        scale = vector(shape, "scale", (1.0, 1.0, 1.0))
        pieces = [] if file is None else read_mesh(file)
        for number_, piece in enumerate(pieces):
            name = f"{filename}:{number_}:{scale}"
            geom = add_piece(spec, body, name, piece, scale)
            if geom is not None:
                finish(geom, position, quat, piece.rgba or colour or GREY)
        return None if pieces else filename
    size = _size(shape)
    if size is not None and size[0] > 0.0:
        kind = _KINDS[shape.tag]
        finish(body.add_geom(type=kind, size=size), position, quat, colour or GREY)
    return None


def check_shapes(urdf: UrdfFile) -> None:
    """Check the sizes and places of all shapes of a URDF, those for looks included.

    Raises:
        RobotError: a size that no robot has; names the link.
    """
    for link in urdf.robot.findall("link"):
        for element in (*link.findall("visual"), *link.findall("collision")):
            place, _ = origin(element)
            if not (np.abs(place) <= LARGEST).all():
                text = ", ".join(f"{side:g}" for side in place)
                raise RobotError(
                    f"the link '{link.get('name')}' has a shape at ({text}) m; "
                    f"expected -{LARGEST:g} to {LARGEST:g}"
                )
            for shape in element.findall("geometry/*"):
                size = _size(shape)
                if size is not None and not ((size >= 0.0) & (size <= LARGEST)).all():
                    text = " x ".join(f"{side:g}" for side in size)
                    raise RobotError(
                        f"the link '{link.get('name')}' has a {shape.tag} of the half sizes {text} "
                        f"m; expected 0 to {LARGEST:g}"
                    )


def _size(shape: Element) -> Array | None:
    """Return MuJoCo's size (3,) of a simple shape in a URDF, a mesh's scale, None for others."""
    if shape.tag == "mesh":
        return np.abs(vector(shape, "scale", (1.0, 1.0, 1.0)))
    if shape.tag == "box":
        return vector(shape, "size", (0.0, 0.0, 0.0)) / 2
    if shape.tag in _KINDS:
        return np.array((number(shape, "radius"), number(shape, "length") / 2, 0.0))
    return None


def add_bones(spec: mujoco.MjSpec) -> None:
    """Draw a robot without shapes: a bone from every body to those that hang on it."""
    for body in spec.bodies[1:]:
        for child in body.bodies:
            length = float(np.linalg.norm(child.pos))
            if length > 2 * BONE:
                bone = body.add_geom(
                    type=mujoco.mjtGeom.mjGEOM_CAPSULE,
                    fromto=(0.0, 0.0, 0.0, *child.pos),
                    size=(BONE, 0.0, 0.0),
                )
                bone.rgba, bone.mass, bone.contype, bone.conaffinity = GREY, 0.0, 0, 0
        ball = body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(1.4 * BONE, 0.0, 0.0))
        finish(ball, np.zeros(3), np.array((1.0, 0.0, 0.0, 0.0)), (0.45, 0.5, 0.6, 1.0))


def finish(
    geom: mujoco.MjsGeom, position: Array, quat: Array, colour: tuple[float, ...] | Array
) -> None:
    """Place and colour a geom that is only looked at."""
    geom.pos, geom.quat, geom.rgba = position, quat, colour
    geom.mass, geom.contype, geom.conaffinity, geom.group = 0.0, 0, 0, VISUAL_GROUP


def _rgba(material: Element) -> tuple[float, ...] | None:
    """Return the colour of a URDF material, None where it names one or only a texture."""
    colour = material.find("color")
    if colour is None or colour.get("rgba") is None:
        return None
    return tuple(vector(colour, "rgba", GREY))
