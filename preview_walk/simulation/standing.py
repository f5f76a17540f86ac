"""How a walk begins: a plant for a robot, and a plan to stand on in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from preview_walk.arguments import shown
from preview_walk.controller.feeling import CAREFUL
from preview_walk.controller.hardware import Hardware
from preview_walk.controller.robot_limits import gait_limits
from preview_walk.controller.walker import Walker
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.laying import lay_on, swung
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import as_heading, pose_at
from preview_walk.reality.realism import Realism
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import at_com_height, standing_configuration
from preview_walk.simulation.plant import Plant
from preview_walk.simulation.real_world import RealWorld
from preview_walk.simulation.world import World
from preview_walk.terrain.ground import FlatGround

_PLANT = ("robot", *sorted(name for name in vars(Plant) if not name.startswith("_")))
"""What a plant has."""


def plant_of(
    robot: Robot | Plant,
    com_height: float | None,
    realism: Realism | None,
    seed: int,
    **settings: Any,
) -> Plant:
    """Return a robot's world with these settings, or a plant as it is.

    Args:
        robot: a robot, or a plant.
        com_height: that the robot is to stand with, m; None leaves its walking posture.
        realism: what is not perfect about the robot; None: nothing.
        seed: of its errors.
        settings: keyword arguments of `World`; None takes its defaults.

    Raises:
        InvalidInput: a setting that cannot be, or that a plant has already.
    """
    given = {name: value for name, value in settings.items() if value is not None}
    require_plant(robot)
    if isinstance(robot, Robot):
        body = robot if com_height is None else at_com_height(robot, com_height)
        return World(body, **given) if realism is None else RealWorld(body, realism, seed, **given)
    own = {"com_height": com_height, "realism": realism}
    names = [*given, *(name for name, value in own.items() if value is not None)]
    if names:
        raise InvalidInput(
            f"{names[0]} must be left out beside a plant, which has its own.", names[0]
        )
    return robot


def require_plant(robot: object) -> None:
    """Raise `InvalidInput` unless this is a robot or has all that a plant has."""
    lacking = [name for name in _PLANT if not hasattr(robot, name)]
    if not isinstance(robot, Robot) and lacking:
        raise InvalidInput(
            f"robot must be a Robot or a Plant, got {shown(robot)}, without {lacking[0]}.", "robot"
        )


def stand(plant: Plant, plan: FootstepPlan, blind: bool, **settings: Any) -> Walker:
    """Stand a plant's robot on a plan's first soles; return its walker.

    Args:
        plant: what is sensed and driven.
        plan: the walk; laid on the plant's ground first.
        blind: whether the walker takes the ground for level and the plan stays as it is.
        settings: keyword arguments of `Walker`.

    Raises:
        InvalidInput: a setting that cannot be, or a plan on which the robot cannot stand.
    """
    robot, ground = plant.robot, None
    if not blind and not isinstance(plant.ground, FlatGround):
        ground = plant.ground
        plan = lay_on(plan, ground, gait_limits(robot))
    if blind:
        plan = swung(plan, FootstepPlan(plan[:2]), CAREFUL)
    q = standing_configuration(robot, plan[0].pose, plan[1].pose)
    plant.place(q, plan.start)
    return Walker(
        robot,
        plan,
        q,
        friction=plant.friction,
        ground=ground,
        blind=blind,
        hardware=hardware_of(plant),
        **settings,
    )


def hardware_of(plant: Plant) -> Hardware | None:
    """Return what is known of a plant's imperfections; None where it has none."""
    if not isinstance(plant, RealWorld):
        return None
    realism = plant.realism
    friction = realism.motors.dry_friction * plant.robot.effort
    late = realism.delay + realism.speed_lag
    return Hardware(late, friction)


def standing_plan(robot: Robot | Plant, start: Sequence[float]) -> FootstepPlan:
    """Return the plan of a robot that stands as wide as in its posture, on the ground.

    Args:
        robot: a robot, on ground of height 0, or a plant with its own.
        start: x, y[, yaw] of the middle of the feet, m, rad.
    """
    require_plant(robot)
    x, y, yaw = as_heading(start, "start")
    if isinstance(robot, Robot):
        width, z = robot.step_width, 0.0
    else:
        width, z = robot.robot.step_width, float(robot.ground.height(x, y))
    plan = FootstepPlanner(step_width=width).stand((x, y, yaw))
    return plan.transformed(pose_at(0.0, 0.0, z=z)) if z else plan
