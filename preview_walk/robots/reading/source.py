"""Where a robot comes from: a URDF, an MJCF file or a compiled MuJoCo model, read as a tree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco

from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.checks import check_numbers
from preview_walk.robots.reading.content import content_of, is_there, shown
from preview_walk.robots.reading.description import model_path
from preview_walk.robots.reading.facts import Description
from preview_walk.robots.reading.mjcf import compile_spec, read_mjcf
from preview_walk.robots.reading.shapes import add_shapes, check_shapes
from preview_walk.robots.reading.urdf import Urdf, read_urdf


@dataclass(frozen=True, eq=False)
class Source:
    """A model read.

    Attributes:
        tree: the compiled model.
        urdf: the URDF that it came from, if any.
        notes: remarks, one sentence each.
    """

    tree: Tree
    urdf: Urdf | None
    notes: tuple[str, ...]

    @property
    def speed(self) -> Mapping[str, float]:
        """Speed limits (rad/s) by joint name; MJCF has none."""
        return {} if self.urdf is None else self.urdf.speed


def read_source(model: Description | mujoco.MjModel) -> Source:
    """Return the model that a description names, or a model in hand, as a tree.

    Args:
        model: the description, or the model in hand.

    Raises:
        RobotError: a file that cannot be read or compiled.
    """
    source = _read(model)
    check_numbers(source.tree, source.speed)
    return source


def _read(model: Description | mujoco.MjModel) -> Source:
    """Return a source whose numbers are not yet checked."""
    if isinstance(model, mujoco.MjModel):
        return Source(Tree(model), None, ())
    path = model_path(model.model)
    if not is_there(path):
        raise RobotError(f"the model file '{shown(path)}' does not exist", argument="model")
    if path.suffix.lower() != ".urdf" and b"<robot" not in content_of(path):
        mj, notes = read_mjcf(path)
        return Source(Tree(mj), None, notes)
    urdf = read_urdf(path)
    check_shapes(urdf.file)
    mj, _ = compile_spec(urdf.spec, f"'{path}'")
    remarks = [f"{flaw}: {', '.join(links)}" for flaw, links in urdf.flaws.items()]
    if urdf.carrying:
        names = ", ".join(urdf.carrying)
        remarks.append(f"joints between world and base became a free joint: {names}")
    return Source(Tree(mj), urdf, tuple(remarks))


def foot_shapes(source: Source, body: int) -> tuple[Tree, list[str]]:
    """Return a tree with the shapes of a foot, and remarks.

    A URDF is read without shapes, because only the feet's matter: its collision shapes, else its
    visual ones.

    Args:
        source: the model.
        body: the foot.

    Raises:
        RobotError: the foot needs a mesh that is missing or not readable.
    """
    if source.urdf is None:
        return source.tree, []
    tree, lost = source.tree, []
    links = {tree.name(part) for part in tree.rigid_part(body)}
    for kind in ("collision", "visual"):
        spec = source.urdf.spec.copy()
        missing = add_shapes(source.urdf.file, spec, kind, links)
        shaped = Tree(compile_spec(spec, f"'{source.urdf.file.path}'")[0])
        if shaped.mj.ngeom:
            notes = (
                []
                if kind == "collision"
                else [
                    f"the sole of '{tree.name(body)}' is found from its visual mesh, "
                    "as it has no collision shape"
                ]
            )
            return shaped, notes
        lost += missing
    if lost:
        raise RobotError(
            f"the foot '{tree.name(body)}' needs the mesh '{lost[0]}', which is not found or not "
            "readable; expected the file, or a description that gives the sole's size and centre"
        )
    return tree, []
