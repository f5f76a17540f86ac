"""What a page shows: a MuJoCo model with its looks, and the poses of its bodies."""

from __future__ import annotations

import mujoco
import numpy as np

from preview_walk.arguments import instance_of
from preview_walk.errors import InvalidInput, RobotError
from preview_walk.record.record import Record
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco
from preview_walk.simulation.ground_geoms import model_on
from preview_walk.simulation.pushes import base_of
from preview_walk.simulation.scene import Scene
from preview_walk.simulation.walk import Walk
from preview_walk.simulation.world import World
from preview_walk.terrain.ground import Ground
from preview_walk.types import Array


class Stage:
    """A model to look at and a state of its own: what simulates is only read, a row at a time.

    Attributes:
        model: with visual meshes and the ground.
        base: id of the robot's base in it.
        data: its body poses follow `set`.
    """

    def __init__(self, model: mujoco.MjModel, base: int) -> None:
        self.model, self.data, self.base = model, mujoco.MjData(model), base
        mujoco.mj_kinematics(model, self.data)

    def set(self, qpos: Array) -> None:
        """Put the bodies where MuJoCo's configuration (nq,) has them."""
        self.data.qpos[:] = qpos
        mujoco.mj_kinematics(self.model, self.data)


def stage_of(walk: Walk) -> Stage:
    """Return the stage of a running walk: of the user's own scene, or of the robot's looks."""
    plant = walk.plant
    if isinstance(plant, Scene):
        return Stage(plant.model, plant.robot.blueprint.parts.base)
    return stage_on(plant.robot, plant.ground)


def stage_on(robot: Robot, ground: Ground) -> Stage:
    """Return the stage of a robot on its ground."""
    model = model_on(robot, ground, visuals=True)
    return Stage(model, base_of(model))


def configuration(walk: Walk) -> Array:
    """Return MuJoCo's configuration (nq,) of a running walk, in the order of its stage."""
    plant = walk.plant
    if isinstance(plant, World | Scene):
        return np.array(plant.data.qpos)
    qpos, qvel = np.empty_like(plant.q), np.empty_like(plant.v)
    to_mujoco(plant.q, plant.v, qpos, qvel)
    return qpos


def robot_of(record: Record, robot: Robot | None) -> Robot:
    """Return the robot of a record: the one given, or the one of that name in the catalogue.

    Raises:
        InvalidInput: it is neither given nor in the catalogue.
    """
    if robot is not None:
        return instance_of(robot, Robot, "robot")
    try:
        return load_robot(record.run.robot)
    except RobotError as error:
        raise InvalidInput(
            f"robot must be given for a record of '{record.run.robot}', which is not in the "
            "catalogue.",
            "robot",
        ) from error
