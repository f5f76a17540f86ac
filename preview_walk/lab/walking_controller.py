"""The walking lab's controller: a humanoid walks in the student's own MuJoCo model and data."""

from __future__ import annotations

import warnings

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.controller.robot_limits import gait_limits
from preview_walk.controller.walker import Walker
from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import Heading, midfeet
from preview_walk.pattern.check import require_walkable
from preview_walk.robots.building.contact_sensor import zmp
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import at_com_height, standing_configuration
from preview_walk.simulation.scene import OwnModel
from preview_walk.simulation.walk import FALL_HEIGHT, FRICTION, STAND_AFTER
from preview_walk.types import FEET, Array

TICK = 0.002
"""The controller computes new torques at most this often (s)."""

_ORIGIN = np.zeros(3)


class WalkingController:
    """Walks a humanoid in a MuJoCo model and data of one's own.

    Args:
        model: the robot on a floor: a free joint at its base, legs of six joints with motors,
            gravity. It is not changed.
        data: its state; the robot walks on from where it stands in it. `run_walking` moves it on.
        com_height: height of the CoM above the soles while standing, m; None takes that of the
            robot's walking posture.

    Attributes:
        robot: what was found in the model.
        planner: sizes and times of the steps: those of the walking lab, but a quarter of the leg
            long for a small robot, and as wide as it stands for one whose soles need more room.
            Assign another `FootstepPlanner` to walk otherwise.
        plan: the footsteps of the last walk; None before it.
        fall: (time in s, reason) where the robot fell in the last walk, else None.

    Raises:
        RobotError: a model that cannot walk; says what is in the way.
        InvalidInput: a com_height that the legs cannot give.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, com_height: float | None = None
    ) -> None:
        robot = load_robot(model)
        self.robot = robot if com_height is None else at_com_height(robot, com_height)
        self.model, self.data = model, data
        self._own = OwnModel(self.robot, model, data)
        width = 0.1 if gait_limits(robot).min_width <= 0.1 else robot.step_width
        self.planner = FootstepPlanner(min(0.15, 0.25 * robot.leg_length), width, 0.6)
        self.plan: FootstepPlan | None = None
        self.fall: tuple[float, str] | None = None

    def run_walking(self, n_steps: int = 6, dt: float = 0.01) -> dict[str, Array]:
        """Walk `n_steps` steps in MuJoCo and return the history, an entry every `dt` seconds.

        The robot is put into its walking posture where it stands, walks, and stands for a second;
        `data` ends in the final state. A fall ends the walk early, with a warning.

        Returns:
            A dictionary of arrays with a row per entry, in the world, SI units. Measured in MuJoCo:
            "time" (N,) from the start of the walk, "com" (N, 3), "zmp" (N, 2) from the contact
            forces (nan in flight), "left_foot" and "right_foot" (N, 3), the centres of the soles,
            "left_force" and "right_force" (N,), the normal forces. Planned: "com_ref" (N, 3),
            "zmp_ref" (N, 2), "left_foot_ref" and "right_foot_ref" (N, 3), and "phase" (N,):
            0 double support, 1 left support, 2 right support. Commanded: "torque" (N, n) in N·m, a
            column for each of `robot.joint_names`.

        Raises:
            InvalidInput: n_steps is not an integer >= 0, dt is not a multiple of the model's
                timestep, or the robot cannot make the steps.
        """
        steps, ticks = self._rates(dt)
        own, robot = self._own, self.robot
        own.sense()
        self.plan = plan = self.planner.generate_footsteps(n_steps, _place(robot, own.q))
        require_walkable(plan, gait_limits(robot))
        q = standing_configuration(robot, plan[0].pose, plan[1].pose)
        own.place(q)
        walker = Walker(robot, plan, q, min(FRICTION, own.friction))
        tick = steps * float(self.model.opt.timestep)
        rows: list[dict[str, Array | float]] = []
        self.fall = None
        for index in range(round((plan.end + STAND_AFTER - plan.start) / tick) + 1):
            t = plan.start + index * tick
            own.sense()
            force = {foot: float(own.wrench[foot][2]) for foot in FEET}
            try:
                torques = walker.tick(t, own.q, own.v, force)
            except PreviewWalkError as stop:
                self.fall = (t, str(stop))
                break
            if index % ticks == 0:
                rows.append(self._row(t, walker, torques))
            height = walker.body.dynamics.com[2]
            if height < FALL_HEIGHT * robot.com_height:
                self.fall = (t, f"the CoM sank to {height:.2f} of {robot.com_height:.2f} m")
                break
            own.step(torques, steps)
        if self.fall is not None:
            warnings.warn(f"fell after {self.fall[0]:.2f} s: {self.fall[1]}", stacklevel=2)
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}

    def _rates(self, dt: float) -> tuple[int, int]:
        """Return the physics steps of a control tick and the ticks from one entry to the next."""
        timestep = float(self.model.opt.timestep)
        count = round(dt / timestep) if np.isfinite(dt) else 0
        if count < 1 or abs(count * timestep - dt) > 1e-9:
            raise InvalidInput(
                f"dt must be a positive multiple of the model's timestep of {timestep:g} s, "
                f"got {dt}."
            )
        most = max(1, round(TICK / timestep))
        steps = max(size for size in range(1, most + 1) if count % size == 0)
        return steps, count // steps

    def _row(self, t: float, walker: Walker, torques: Array) -> dict[str, Array | float]:
        """Return the history's entry at time t (s)."""
        own, dynamics, reference = self._own, walker.body.dynamics, walker.reference
        assert reference is not None
        up = np.array((0.0, 0.0, own.floor))
        wrenches = (own.wrench["left"], own.wrench["right"])
        left, right = (walker.feet[foot].pose[:3, 3] for foot in FEET)
        return {
            "time": t,
            "com": dynamics.com + up,
            "zmp": zmp(wrenches, (_ORIGIN, _ORIGIN), own.floor),
            "left_foot": dynamics.soles["left"].position + up,
            "right_foot": dynamics.soles["right"].position + up,
            "left_force": float(wrenches[0][2]),
            "right_force": float(wrenches[1][2]),
            "com_ref": reference.com + up,
            "zmp_ref": np.array(reference.zmp_ref),
            "left_foot_ref": left + up,
            "right_foot_ref": right + up,
            "phase": walker.plan.support(t),
            "torque": torques,
        }


def _place(robot: Robot, q: Array) -> Heading:
    """Return the middle of the soles, from above, in a configuration q (nq,)."""
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, q)
    left, right = (data.oMf[robot.soles[foot].frame].homogeneous for foot in FEET)
    return midfeet(left, right)
