"""A walk as a gymnasium environment: a velocity command in, the state out, ten decisions a second.

    python examples/gym_environment.py

The action is what a policy would choose where the walker does the rest: forward, left and turning
speed. Here a rule steers TALOS to a point; the reward is what it comes closer.
"""

from typing import Any

import gymnasium as gym
import numpy as np

import preview_walk as pw


class WalkEnvironment(gym.Env[np.ndarray, np.ndarray]):
    """TALOS walks to a point in the plane.

    Action: vx, vy (m/s), yaw rate (rad/s). Observation: the goal seen from between the feet (m),
    the CoM's velocity in that frame (m/s), the time (s).
    """

    PERIOD = 0.1  # s from one action to the next

    def __init__(self, robot: pw.Robot) -> None:
        self.robot, self.dynamics = robot, pw.Dynamics(robot)
        high = np.array([0.4, 0.1, 0.4], dtype=np.float32)
        self.action_space = gym.spaces.Box(-high, high)
        self.observation_space = gym.spaces.Box(-np.inf, np.inf, (5,), np.float64)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Stand at the origin; the goal is 1 to 2 m away, ahead or aside."""
        super().reset(seed=seed)
        angle, way = self.np_random.uniform((-0.8, 1.0), (0.8, 2.0))
        self.goal = way * np.array((np.cos(angle), np.sin(angle)))
        self.walk = pw.Walk.standing(self.robot)
        self.distance = float(np.linalg.norm(self.goal))
        return self._observation(), {}

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Walk by the command for a tenth of a second."""
        vx, vy, wz = np.clip(action, self.action_space.low, self.action_space.high).tolist()
        self.walk.command(vx, vy, wz)
        self.walk.run(until=self.walk.time + self.PERIOD)
        seen = self._observation()
        before, self.distance = self.distance, float(np.linalg.norm(seen[:2]))
        return seen, before - self.distance, self.walk.fallen, self.distance < 0.1, {}

    def _observation(self) -> np.ndarray:
        dynamics, plant = self.dynamics, self.walk.plant
        dynamics.update(plant.q, plant.v)
        x, y, yaw = pw.midfeet(*(dynamics.soles[foot].pose for foot in pw.FEET))
        c, s = np.cos(yaw), np.sin(yaw)
        turn = np.array(((c, s), (-s, c)))
        ahead, speed = turn @ (self.goal - (x, y)), turn @ dynamics.com_velocity[:2]
        return np.concatenate((ahead, speed, [self.walk.time]))


def steer(seen: np.ndarray) -> np.ndarray:
    """Return the velocity that leads to the goal: ahead as far as it lies ahead, turning to it."""
    x, y = seen[:2]
    return np.array((0.6 * x, 0.2 * y, np.arctan2(y, max(x, 0.2))))


if __name__ == "__main__":
    environment = WalkEnvironment(pw.load_robot("talos"))
    for seed in range(2):
        seen, _ = environment.reset(seed=seed)
        print(f"goal {seed} lies {seen[0]:.2f} m ahead, {seen[1]:+.2f} m to the left")
        total, ended = 0.0, False
        while not ended and environment.walk.time < 20.0:
            seen, reward, fallen, there, _ = environment.step(steer(seen))
            total, ended = total + reward, fallen or there
        end = "fell" if fallen else "is there" if there else "is on the way"
        print(f"  {end} after {environment.walk.time:.1f} s, {total:.2f} m closer")
