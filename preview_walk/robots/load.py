"""`load_robot`: from a name, a file or a model in hand to a robot ready to walk."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from preview_walk.errors import RobotError, about
from preview_walk.robots.building.assemble import assemble
from preview_walk.robots.building.build import build_robot
from preview_walk.robots.building.rebuild import rebuild
from preview_walk.robots.reading.description import describe
from preview_walk.robots.reading.facts import Description
from preview_walk.robots.reading.mjcf import compile_spec
from preview_walk.robots.reading.shapes import add_bones, add_shapes
from preview_walk.robots.reading.source import read_source
from preview_walk.robots.robot import Robot


def load_robot(model: str | Path | mujoco.MjModel | mujoco.MjSpec) -> Robot:
    """Return a robot ready to walk.

    Args:
        model: a name of the catalogue, the path of a .urdf, .xml, .mjcf or .json file, or a MuJoCo
            model or spec in hand, which is left as it is.

    Raises:
        RobotError: an unknown name, or a model that cannot walk; says what is in the way.
    """
    with about("model"):
        return _load(model)


def _load(model: object) -> Robot:
    if isinstance(model, mujoco.MjSpec):
        model, notes = compile_spec(model.copy(), "the spec")
        return build_robot(_in_hand(model), replace(read_source(model), notes=notes))
    if isinstance(model, mujoco.MjModel):
        return build_robot(_in_hand(model), read_source(model))
    if not isinstance(model, (str, Path)):
        raise RobotError(
            f"expected a robot's name, a path, an MjModel or an MjSpec, got {type(model).__name__}"
        )
    description = describe(model)
    return build_robot(description, read_source(description))


def _in_hand(model: mujoco.MjModel) -> Description:
    """Return what is known beforehand of a model that was not loaded from a file: its name."""
    name = bytes(model.names).split(b"\0", 1)[0].decode()
    name = "robot" if name in ("", "MuJoCo Model") else name
    return Description(name, name, "MjModel")


def visual_model(robot: Robot) -> mujoco.MjModel:
    """Return the robot's MuJoCo model with its visual shapes: same bodies, joints and state.

    Args:
        robot: the robot, or a copy of one.
    """
    model = spec_of(robot, visuals=True).compile()
    assert np.array_equal(model.qpos0, robot.mj.qpos0)
    return model


def spec_of(robot: Robot, visuals: bool) -> mujoco.MjSpec:
    """Return the spec of the robot's MuJoCo model, to add to before it is compiled.

    Visual meshes that are missing, or that need trimesh or pycollada where these are not installed,
    are left out; a robot that has none at all is drawn as bones from joint to joint.

    Args:
        robot: the robot, or a copy of one.
        visuals: with its visual shapes.
    """
    plan = robot.blueprint
    looks = visuals and plan.urdf is None
    spec, _ = rebuild(plan.tree, plan.parts.base, plan.locked, looks=looks)
    if visuals and plan.urdf is not None:
        add_shapes(plan.urdf, spec, "visual")
    if visuals and not spec.geoms:
        add_bones(spec)
    assemble(spec, plan.soles, plan.efforts)
    for name in plan.unlimited:
        spec.joint(name).limited = False
    return spec
