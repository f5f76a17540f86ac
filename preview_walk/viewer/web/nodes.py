"""The bodies and the ground of a MuJoCo model as nodes of a page's scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

if TYPE_CHECKING:
    from viser import SceneApi

ROOT = "/world"
"""Node of the world's frame; all others lie in it."""

HIDDEN_GROUP = 3
"""Geoms of this group and beyond are for contacts alone, as in MuJoCo's own viewer."""

EDGE = 0.5
"""Faces of the ground that meet at more than this angle (rad) meet at an edge, which is drawn."""

FACETED = 500
"""A shape of so few faces is a box or the like: its faces are flat, those of a mesh are not."""

EDGE_COLOUR = (70, 75, 80)

SHADE = 0.6
"""The ground is drawn darker than it is: under the page's bright light its edges show then."""

_PLANE = int(mujoco.mjtGeom.mjGEOM_PLANE)


class BodyNodes:
    """One frame per moving body; `update` moves the frames, meshes are sent once.

    Attributes:
        root: viser's handle of the world's frame.
        frames: those of the moving bodies, by their ids.
    """

    def __init__(self, scene: SceneApi, model: mujoco.MjModel) -> None:
        """Add bodies and ground to a scene.

        Args:
            scene: of the page.
            model: with whatever is to be seen.
        """
        self.root = scene.add_frame(ROOT, show_axes=False)
        self.frames: dict[int, Any] = {}
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        for body, geoms in _seen(model).items():
            name = f"{ROOT}/{_name(model, body)}"
            frame = scene.add_frame(name, show_axes=False)
            frame.position, frame.wxyz = data.xpos[body], data.xquat[body]
            if model.body_weldid[body] != 0:
                self.frames[body] = frame
            solids = [geom for geom in geoms if model.geom_type[geom] != _PLANE]
            for geom in set(geoms) - set(solids):
                _add_plane(scene, f"{name}/plane_{geom}", model, geom)
            _add_solids(scene, name, model, solids)

    def update(self, data: mujoco.MjData) -> None:
        """Move the bodies to where `data` has them."""
        for body, frame in self.frames.items():
            frame.position, frame.wxyz = data.xpos[body], data.xquat[body]


def _seen(model: mujoco.MjModel) -> Mapping[int, list[int]]:
    """Return the geoms (ids) to be seen, by their body."""
    seen: dict[int, list[int]] = {}
    for geom in range(model.ngeom):
        if model.geom_group[geom] < HIDDEN_GROUP and model.geom_rgba[geom, 3] > 0.0:
            seen.setdefault(int(model.geom_bodyid[geom]), []).append(geom)
    return seen


def _name(model: mujoco.MjModel, body: int) -> str:
    """Return a body's name as a part of a path."""
    return (model.body(body).name or "body").replace("/", "_") + f"_{body}"


def _add_solids(scene: SceneApi, name: str, model: mujoco.MjModel, geoms: list[int]) -> None:
    """Add the meshes and simple shapes of a body, as few nodes as their textures allow."""
    from mjviser.conversions import group_geoms_by_visual_compat, merge_geoms
    from trimesh.visual import ColorVisuals

    fixed = model.body_weldid[model.geom_bodyid[geoms[0]]] == 0 if geoms else False
    for number, alike in enumerate(group_geoms_by_visual_compat(model, geoms)):
        mesh = merge_geoms(model, alike)
        if fixed:
            _add_edges(scene, f"{name}/edges_{number}", mesh)
        if fixed or len(mesh.faces) <= FACETED:
            mesh.unmerge_vertices()  # so that every face has its own normal
        if fixed and isinstance(mesh.visual, ColorVisuals):
            mesh.visual.vertex_colors[:, :3] = SHADE * mesh.visual.vertex_colors[:, :3]
        scene.add_mesh_trimesh(f"{name}/mesh_{number}", mesh)


def _add_edges(scene: SceneApi, name: str, mesh: Any) -> None:
    """Draw the edges of the ground, which are not seen from above otherwise."""
    sharp = mesh.face_adjacency_edges[mesh.face_adjacency_angles > EDGE]
    if len(sharp):
        scene.add_line_segments(name, mesh.vertices[sharp], colors=EDGE_COLOUR)


def _add_plane(scene: SceneApi, name: str, model: mujoco.MjModel, geom: int) -> None:
    """Add a plane as a grid of 0.5 m, endless where the model's is."""
    width, height = (2.0 * model.geom_size[geom, :2]).tolist()
    colour = np.clip(255 * model.geom_rgba[geom, :3] + 90, 0, 235).astype(np.uint8)
    scene.add_grid(
        name,
        width or 1.0,
        height or 1.0,
        infinite_grid=not (width and height),
        fade_distance=30.0,
        plane_color=colour,
        plane_opacity=1.0,
        shadow_opacity=0.3,
        position=model.geom_pos[geom],
        wxyz=model.geom_quat[geom],
    )
