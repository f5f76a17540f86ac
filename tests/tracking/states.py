"""States, controllers and problems for the tests of the tracking room."""

import numpy as np
import pinocchio as pin

from preview_walk.robots.robot import Robot
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot

FRICTION = 0.8


def random_state(robot: Robot, seed: int, spread: float = 0.2) -> tuple[Array, Array]:
    """Return a configuration near the walking posture, turned at will, and a velocity."""
    rng = np.random.default_rng(seed)
    step = spread * rng.standard_normal(robot.pin.nv)
    step[3:6] *= 3.0
    q = pin.integrate(robot.pin, robot.posture, step)
    return q, rng.standard_normal(robot.pin.nv)


def standing_controller(
    robot: Robot, solver: str = "osqp", gains: TrackingGains | None = None
) -> WholeBodyController:
    """Return a controller updated at the walking posture, at rest."""
    body = WholeBodyController(robot, gains or TrackingGains(), FRICTION, solver)
    body.update(np.array(robot.posture), np.zeros(robot.pin.nv))
    return body


def full_load(robot: Robot, *feet: Foot) -> dict[Foot, float]:
    """Return a normal limit that never matters for these feet (default: both)."""
    return dict.fromkeys(feet or FEET, 20.0 * robot.mass)


def busy_problem(robot: Robot, seed: int, *feet: Foot) -> TickProblem:
    """Return a filled problem at a random state whose tasks ask for much."""
    body = WholeBodyController(robot, TrackingGains(), FRICTION)
    q, v = random_state(robot, seed, 0.05)
    body.update(q, 0.1 * v)
    rng = np.random.default_rng(seed)
    body.com.acceleration = 3.0 * rng.standard_normal(3)
    for foot, task in body.foot_tasks.items():
        task.pose = np.eye(4)
        task.pose[:3, 3] = body.dynamics.soles[foot].position + 0.05
        task.acceleration = 5.0 * rng.standard_normal(6)
    return body.problem(full_load(robot, *feet))
