"""Read a URDF as a MuJoCo spec: links kept apart, meshes found, a floating base added."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import mujoco

from preview_walk.errors import RobotError


def urdf_spec(path: Path, visuals: bool = False) -> mujoco.MjSpec:
    """Return the MuJoCo spec of a URDF with its root link on a free joint.

    Only masses, joints and limits are kept; collision geometry is dropped, because soles are boxes
    (`preview_walk.robots.assemble`) and nothing else touches. With `visuals` the visual meshes
    that MuJoCo reads are kept for pictures. Raises `RobotError` for a file that is not a URDF.
    """
    try:
        robot = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise RobotError(f"cannot read '{path}' as a URDF: {error}") from error
    if robot.tag != "robot":
        raise RobotError(f"'{path}' holds <{robot.tag}>; expected a URDF, whose root is <robot>")
    for link in robot.findall("link"):
        for element in link.findall("collision"):
            link.remove(element)
        for element in link.findall("visual"):
            mesh = element.find("geometry/mesh")
            if not visuals or mesh is None:
                link.remove(element)
                continue
            file = mesh_file(mesh.get("filename", ""), path)
            if file is None or file.suffix.lower() not in (".stl", ".obj"):
                link.remove(element)
            else:
                mesh.set("filename", str(file))
    extension = ElementTree.SubElement(robot, "mujoco")
    ElementTree.SubElement(
        extension,
        "compiler",
        fusestatic="false",
        strippath="false",
        discardvisual="false",
        balanceinertia="true",
    )
    spec = mujoco.MjSpec.from_string(ElementTree.tostring(robot, encoding="unicode"))
    base = spec.worldbody.first_body()
    if base is None:
        raise RobotError(f"'{path}' has no links")
    base.add_freejoint(name="root")
    return spec


def mesh_file(filename: str, urdf: Path) -> Path | None:
    """Return the file of a URDF mesh address (package://, file:// or relative), None if absent."""
    bare = filename.removeprefix("package://").removeprefix("file://")
    candidates = [Path(bare), urdf.parent / bare]
    # package://NAME/rest: NAME is a folder above the file, or rest lies beside such a folder.
    rest = Path(*Path(bare).parts[1:]) if len(Path(bare).parts) > 1 else Path(bare)
    for above in urdf.resolve().parents:
        candidates += [above / bare, above / rest]
    return next((file for file in candidates if file.is_file()), None)
