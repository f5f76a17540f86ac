"""What a controller sees of its plant: the truth, or what an estimator makes of the sensors."""

from __future__ import annotations

from typing import Any

import numpy as np

from preview_walk.controller.walker import Walker
from preview_walk.estimation.estimator import Estimate, Estimator
from preview_walk.reality.realism import sensor_noise
from preview_walk.simulation.plant import Plant
from preview_walk.simulation.real_world import RealWorld
from preview_walk.terrain.ground import FlatGround


class PerfectSight:
    """The state as the plant has it."""

    def __init__(self, plant: Plant) -> None:
        """Look at a plant."""
        self._plant = plant

    def look(self, walker: Walker) -> Estimate:
        """Return the state at this tick."""
        plant = self._plant
        return Estimate(plant.q, plant.v, plant.wrench)


class EstimatedSight:
    """The state as the sensors let it be told.

    Attributes:
        estimator: tells it.
        measured: the readings of the last tick.
        seen: what it told then.
    """

    def __init__(self, plant: RealWorld, walker: Walker, dt: float) -> None:
        """Look at a plant through its sensors, every dt (s)."""
        robot, realism = plant.robot, plant.realism
        self._plant, self._dt, self._elapsed = plant, dt, 0.0
        self.measured = plant.measure(0.0)
        samples = max(1, round(dt / plant.timestep))
        noise = sensor_noise(realism, robot.leg_length, samples, dt)
        ground = None if walker.blind else walker.ground or FlatGround()
        q = np.array(walker.body.dynamics.q)
        self.estimator = Estimator(robot, q, noise, realism.delay, ground)
        self.seen = Estimate(q, np.zeros(robot.pin.nv), plant.wrench)

    def look(self, walker: Walker) -> Estimate:
        """Return the state at the time when this tick's torques act."""
        solution = walker.body.solution
        asked = np.zeros(walker.body.dynamics.nv) if solution is None else solution.acceleration
        self.measured = self._plant.measure(self._elapsed)
        self.seen = self.estimator.update(self.measured, asked, self._elapsed)
        self._elapsed = self._dt
        return self.seen

    def row(self) -> dict[str, Any]:
        """Return what a record holds of this tick beside the truth, by name."""
        measured, base = self.measured, self.estimator.base
        return {
            "estimate_q": self.seen.q,
            "estimate_v": self.seen.v,
            "angles": measured.angles,
            "speeds": measured.speeds,
            "gyro": measured.gyro,
            "accelerometer": measured.accelerometer,
            "gyro_bias": base.gyro_bias,
            "accelerometer_bias": base.accelerometer_bias,
            "spread": np.sqrt(np.diag(base.covariance)[:9]),
            "left_sole": measured.wrench["left"],
            "right_sole": measured.wrench["right"],
            "motor_torque": self._plant.torques,
            "true_com": self._plant.com,
            "refused": self.estimator.refused,
        }


def sight_of(plant: Plant, walker: Walker, dt: float) -> PerfectSight | EstimatedSight:
    """Return what the walker sees of its plant, looking every dt (s)."""
    if isinstance(plant, RealWorld):
        return EstimatedSight(plant, walker, dt)
    return PerfectSight(plant)
