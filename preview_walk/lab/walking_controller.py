"""The walking lab's controller: a humanoid walks in the student's own MuJoCo model and data."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from math import hypot
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from preview_walk.arguments import finite_number, instance_of
from preview_walk.controller.robot_limits import gait_limits
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.poses import Heading, midfeet, pose_at, relative
from preview_walk.pattern.check import require_walkable
from preview_walk.record.record import Record
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import at_com_height
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.scene import Scene
from preview_walk.simulation.walk import CONTROL_HZ, Walk

NEAR = (0.1, 0.2)
"""A plan begins where the robot stands when the middles of its first soles and of the robot's own
are no further apart than this (m, rad): standing into the walking posture shifts them by less."""


class WalkingController:
    """Walks a humanoid in a MuJoCo model and data of one's own: `Walk` on that `Scene`.

    Attributes:
        robot: what was found in the model.
        planner: sizes and times of the steps: those of the walking lab, but a quarter of the leg
            long for a small robot, and as wide as it stands for one whose soles need more room.
            Assign another `FootstepPlanner` to walk otherwise.
        com_height: of the CoM above the soles while standing, m; may be assigned.
        plan: the footsteps of the last walk; None before it.
        record: of the last walk, with all that was planned and measured; None before it.
        fall: (time in s, reason) where the robot fell in the last walk, else None.
    """

    __slots__ = ("_plan", "_record", "_robot", "_scene_of", "planner")

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, com_height: float | None = None
    ) -> None:
        """Find the robot in the model.

        Args:
            model: the robot on a floor: a free joint at its base, legs of six joints with motors,
                gravity. It is not changed.
            data: its state; the robot walks on from where it stands in it. `run_walking` moves it.
            com_height: of the CoM above the soles while standing, m; None takes that of the robot's
                walking posture.

        Raises:
            RobotError: a model that cannot walk; says what is in the way.
            InvalidInput: a com_height that the legs cannot give.
        """
        instance_of(model, mujoco.MjModel, "model")
        robot = load_robot(model)
        self._scene_of = (model, data)
        Scene(robot, model, data)  # says at once what is in the way
        self._robot = robot if com_height is None else at_com_height(robot, com_height)
        width = 0.1 if gait_limits(robot).min_width <= 0.1 else robot.step_width
        self.planner = FootstepPlanner(min(0.15, 0.25 * robot.leg_length), width, 0.6)
        self._plan: FootstepPlan | None = None
        self._record: Record | None = None

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse what would be ignored."""
        settable = [*self.__slots__, "com_height"]
        if name not in settable:
            raise InvalidInput(
                f"{name} of a WalkingController cannot be assigned; planner and com_height can, "
                "and run_walking takes plan, pushes, turn, swing_height and on_tick.",
                name,
            )
        if name == "planner":
            instance_of(value, FootstepPlanner, name)
        object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        return f"WalkingController({self._robot.name}, {self.planner!r})"

    @property
    def robot(self) -> Robot:
        """What was found in the model."""
        return self._robot

    @property
    def com_height(self) -> float:
        """Height of the CoM above the soles while standing, m."""
        return self._robot.com_height

    @com_height.setter
    def com_height(self, com_height: float) -> None:
        self._robot = at_com_height(self._robot, com_height)

    @property
    def model(self) -> mujoco.MjModel:
        """The user's model."""
        return self._scene_of[0]

    @property
    def data(self) -> mujoco.MjData:
        """The user's data."""
        return self._scene_of[1]

    @property
    def plan(self) -> FootstepPlan | None:
        """The footsteps of the last walk, as they were when it ended; None before it."""
        return self._plan

    @property
    def record(self) -> Record | None:
        """The record of the last walk, with all that was planned and measured; None before it."""
        return self._record

    @property
    def fall(self) -> tuple[float, str] | None:
        """(time in s, reason) where the robot fell in the last walk, else None."""
        run = None if self._record is None else self._record.run
        if run is None or run.fall_time is None:
            return None
        return run.fall_time, str(run.fall_reason)

    def run_walking(
        self,
        n_steps: int = 6,
        dt: float = 0.01,
        *,
        plan: PlanLike | None = None,
        pushes: Sequence[Push] = (),
        turn: float = 0.0,
        swing_height: float | None = None,
        on_tick: Callable[[Walk], None] | None = None,
    ) -> dict[str, NDArray[Any]]:
        """Walk in MuJoCo and return the history: the record's arrays, a row every `dt` seconds.

        The robot is put into its walking posture where it stands, walks, and stands for a second;
        `data` ends in the final state. A fall ends the walk early, with a warning. `record` has
        every tick.

        Args:
            n_steps: of the planner, where no plan is given.
            dt: from one row of the history to the next, s; a multiple of the model's timestep.
            plan: footsteps from where the robot stands; None lets the planner make them.
            pushes: forces on the robot's bodies.
            turn: change of heading from one landing of the planner to the next, rad, left positive.
            swing_height: of a swing's apex above the higher of its soles, m; None: by the leg.
            on_tick: called with the `Walk` at the end of every tick.

        Returns:
            The arrays of `Record` by name, in the world, SI units: "time" (N,) from the start of
            the walk, "com" and "com_ref" (N, 3), "zmp" and "zmp_ref" (N, 2), "left_foot" and
            "left_foot_ref" (N, 4, 4), "left_force" (N, 6), "phase" and "phase_ref" (N,), "tau"
            (N, n), and all others.

        Raises:
            InvalidInput: an argument that cannot be, or steps that the robot cannot make.
        """
        steps, ticks = _rates(float(self.model.opt.timestep), dt)
        scene = Scene(self._robot, self.model, self.data, pushes)
        place, z = _place(scene)
        if plan is None:
            plan = self.planner.generate_footsteps(n_steps, place, turn=turn)
            plan = plan.transformed(pose_at(0.0, 0.0, z=z))
        else:
            plan = _given(plan, place, turn)
        require_walkable(plan, gait_limits(self._robot))
        walk = Walk(
            scene,
            plan,
            control_hz=1.0 / (steps * scene.timestep),
            swing_height=swing_height,
            on_tick=on_tick,
        )
        record = walk.run().record()
        self._plan, self._record = walk.plan, record
        if self.fall is not None:
            warnings.warn(f"fell after {self.fall[0]:.2f} s: {self.fall[1]}", stacklevel=2)
        return {name: array[::ticks] for name, array in record.arrays().items()}


def _given(plan: PlanLike, place: Heading, turn: float) -> FootstepPlan:
    """Return a plan that somebody gives; raises `InvalidInput` for one that does not begin here."""
    if finite_number(turn, "turn", "rad") != 0.0:
        raise InvalidInput(
            f"turn must be left out beside a plan, which has its own, got {turn}.", "turn"
        )
    given = as_plan(plan)
    _require_near(given, place)
    return given


def _rates(timestep: float, dt: float) -> tuple[int, int]:
    """Return the physics steps of a control tick and the ticks from one row to the next."""
    dt = finite_number(dt, "dt", "s")
    count = round(dt / timestep)
    if count < 1 or abs(count * timestep - dt) > 1e-9:
        raise InvalidInput(
            f"dt must be a positive multiple of the model's timestep of {timestep:g} s, got {dt}.",
            "dt",
        )
    most = max(1, round(1.0 / (CONTROL_HZ * timestep)))
    steps = max(size for size in range(1, most + 1) if count % size == 0)
    return steps, count // steps


def _place(scene: Scene) -> tuple[Heading, float]:
    """Return the middle of the robot's soles, from above, and the ground's height (m) there."""
    scene.sense()
    soles = scene.soles()
    place = midfeet(soles["left"], soles["right"])
    return place, float(scene.ground.height(place[0], place[1]))


def _require_near(plan: FootstepPlan, place: Heading) -> None:
    """Raise `InvalidInput` unless a plan begins where the robot stands."""
    x, y, turn = relative(place, midfeet(plan[0].pose, plan[1].pose))
    if hypot(x, y) > NEAR[0] or abs(turn) > NEAR[1]:
        raise InvalidInput(
            f"the plan must begin where the robot stands, within {NEAR[0]} m and {NEAR[1]} rad "
            f"({np.degrees(NEAR[1]):.1f} degrees), got one {hypot(x, y):.3f} m off, turned by "
            f"{turn:.3f} rad ({np.degrees(turn):.1f} degrees).",
            "plan",
        )
