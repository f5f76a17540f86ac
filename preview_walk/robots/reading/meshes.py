"""Find and read mesh files: STL and OBJ by MuJoCo, all others by trimesh where it is installed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from preview_walk.robots.bounds import LARGEST
from preview_walk.robots.reading.content import is_there
from preview_walk.types import Array

GREY = (0.7, 0.7, 0.72, 1.0)
"""Colour of a shape that has none."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Part of a mesh in one colour: vertices (n, 3) in m, faces (m, 3), rgba."""

    vertices: Array
    faces: np.ndarray[Any, np.dtype[np.int32]]
    rgba: tuple[float, float, float, float] | None


def mesh_file(filename: str, urdf: Path) -> Path | None:
    """Return the file of a URDF mesh address (package://, file:// or relative), None if absent."""
    bare = filename.removeprefix("package://").removeprefix("file://")
    candidates = [Path(bare), urdf.parent / bare]
    # package://NAME/rest: NAME is a folder above the file, or rest lies beside such a folder.
    rest = Path(*Path(bare).parts[1:]) if len(Path(bare).parts) > 1 else Path(bare)
    for above in urdf.resolve().parents:
        candidates += [above / bare, above / rest]
    return next((file for file in candidates if is_there(file)), None)


def read_mesh(file: Path) -> list[Piece]:
    """Return a mesh file's pieces with their colours, [] where it cannot be read.

    STL needs nothing but numpy; other formats need the optional trimesh (and pycollada for DAE).
    """
    try:
        if file.suffix.lower() == ".stl" and (piece := _binary_stl(file)) is not None:
            return [piece]
        import trimesh

        scene = trimesh.load_scene(file)
    except Exception:  # a missing library, a missing texture, a broken file: no picture of it
        return []
    turn = _collada_frame(file) if file.suffix.lower() == ".dae" else np.eye(3)
    pieces = []
    for mesh in scene.dump():
        if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces):
            pieces.append(
                Piece(
                    np.asarray(mesh.vertices, np.float64) @ turn.T,
                    np.asarray(mesh.faces, np.int32),
                    _colour(mesh.visual),
                )
            )
    return pieces


def _binary_stl(file: Path) -> Piece | None:
    """Return the triangles of a binary STL, None for an ASCII one."""
    content = file.read_bytes()
    count = int.from_bytes(content[80:84], "little")
    if len(content) != 84 + 50 * count or count == 0:
        return None
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    corners = np.frombuffer(content, record, count, 84)["corners"].reshape(-1, 3)
    vertices, index = np.unique(corners, axis=0, return_inverse=True)
    return Piece(vertices.astype(np.float64), index.reshape(-1, 3).astype(np.int32), None)


def _collada_frame(file: Path) -> Array:
    """Return what takes a COLLADA file's points to metres with z up (3, 3): trimesh leaves both."""
    head = file.read_text(errors="replace")
    unit = re.search(r"<unit[^>]*meter=\"([^\"]+)\"", head)
    scale = float(unit.group(1)) if unit else 1.0
    if re.search(r"<up_axis>\s*Y_UP", head):
        return scale * np.array(((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
    return scale * np.eye(3)


def _colour(visual: Any) -> tuple[float, float, float, float] | None:
    """Return the main colour of a trimesh visual."""
    try:
        material = getattr(visual, "material", None)
        if max(getattr(material, "kwargs", {}).get("kd", (0.0,))) > 1.0:
            return None  # brighter than bright: a slip of an exporter
        rgba = visual.main_color if material is None else material.main_color
        red, green, blue, alpha = (float(value) / 255.0 for value in rgba)
    except Exception:  # textures and exotic materials have no main colour
        return None
    # Invisible is an exporter's slip: COLLADA's transparency is written both ways round.
    return (red, green, blue, alpha) if alpha > 0.0 else None


def add_piece(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, piece: Piece, scale: Array
) -> mujoco.MjsGeom | None:
    """Add a piece to a body as a mesh geom; None where it is too flat, small or large to be one."""
    vertices = piece.vertices * scale
    if len(vertices) < 4 or not np.abs(vertices).max() < LARGEST:
        return None
    if float(np.ptp(vertices, axis=0).min()) < 1e-6:
        return None
    faces = piece.faces if float(np.prod(scale)) > 0.0 else piece.faces[:, ::-1]
    if spec.mesh(name) is None:
        spec.add_mesh(
            name=name,
            uservert=vertices.reshape(-1).astype(np.float32),
            userface=faces.reshape(-1).astype(np.int32),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
    return body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name)
