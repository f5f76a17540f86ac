"""A walk in MuJoCo: the loop that senses, ticks the controller, steps the physics and records."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict
from time import perf_counter
from typing import Any

import numpy as np

from preview_walk.controller.robot_limits import command_limits
from preview_walk.controller.walker import Walker
from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.velocity import follow_velocity, saturated
from preview_walk.record.record import Record
from preview_walk.record.recorder import Recorder
from preview_walk.robots.load import visual_model
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import standing_configuration
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.rates import require_rates
from preview_walk.simulation.row import run_settings, tick_row
from preview_walk.simulation.world import World, steps_per_tick
from preview_walk.threads import one_thread
from preview_walk.tracking.gains import TrackingGains
from preview_walk.types import FEET

FRICTION = 0.8
"""Default Coulomb friction between sole and floor: rubber on dry floor."""

STAND_AFTER = 1.0
"""Time (s) that a run goes on after the plan's end, standing."""

FALL_HEIGHT = 0.7
"""The robot has fallen when its CoM is below this share of its height above the soles ..."""

FALL_TILT = 0.9
"""... or its torso leans further than this (rad)."""

FORGET = 3.0
"""A walk by command forgets footsteps older than this (s): an endless walk keeps a short plan."""

Command = tuple[float, float, float]
"""Velocity commanded: vx, vy (m/s), yaw rate (rad/s), in the frame of the walking robot."""

Progress = Callable[[float, float], None]
"""Called now and then with the simulated time and its end (s)."""


class Walk:
    """A running walk; `simulate` and `simulate_commands` are the short ways.

    Args:
        robot: from `load_robot`.
        plan: the footsteps; the robot starts standing on its two stance soles.
        physics_hz, control_hz: rates; the first is a multiple of the second.
        friction: Coulomb friction between soles and floor; the controller knows it.
        pushes: forces on the body.
        seed: seeds whatever is random in the run; kept with the record.
        gains: weights and gains of the tracker.
        solver: "osqp" or another backend of qpsolvers.
        visuals: run on the model with visual meshes, for the live viewer.

    Raises:
        InvalidInput: a rate or friction that cannot be, or a plan on which the robot cannot stand.

    `limits`: what steps the robot's legs can make.
    """

    def __init__(
        self,
        robot: Robot,
        plan: FootstepPlan,
        *,
        physics_hz: int = 1000,
        control_hz: int = 500,
        friction: float = FRICTION,
        pushes: Sequence[Push] = (),
        seed: int = 0,
        gains: TrackingGains | None = None,
        solver: str = "osqp",
        visuals: bool = False,
    ) -> None:
        if not (np.isfinite(friction) and friction > 0.0):
            raise InvalidInput(f"friction must be > 0, got {friction}.", argument="friction")
        self.robot = robot
        self._substeps = steps_per_tick(physics_hz, control_hz)
        require_rates(physics_hz, control_hz, TrackingGains() if gains is None else gains)
        self._dt = 1.0 / control_hz
        model = visual_model(robot) if visuals else robot.mj
        self.world = World(robot, model, physics_hz, friction, pushes)
        q = standing_configuration(robot, plan[0].pose, plan[1].pose)
        self.world.place(q)
        self.world.data.time = plan.start
        self.walker = Walker(robot, plan, q, friction, gains, solver)
        self.limits = command_limits(robot)
        self._command = (0.0, 0.0, 0.0)
        self._obey_at = np.inf
        self._schedule: list[tuple[float, Command]] = []
        self._tick = 0
        self._start = plan.start
        self._wall = 0.0
        self._fall: tuple[float, str] | None = None
        self._interrupted = False
        self._recorder = Recorder(
            run_settings(
                robot,
                pushes,
                self.world,
                self.walker,
                control_hz=control_hz,
                physics_hz=physics_hz,
                friction=friction,
                seed=seed,
                solver=solver,
                gains=asdict(self.walker.gains),
            ),
            {"nq": robot.pin.nq, "nv": robot.pin.nv, "nu": robot.pin.nv - 6},
        )

    @classmethod
    def standing(cls, robot: Robot, start: Sequence[float] = (0.0, 0.0), **settings: Any) -> Walk:
        """Return a walk that stands at `start` (x, y[, yaw]; m, rad), to be moved by `command`.

        `settings` are the keyword arguments of `Walk`.
        """
        planner = FootstepPlanner(step_width=robot.step_width)
        return cls(robot, planner.generate_footsteps(0, start), **settings)

    @property
    def time(self) -> float:
        """Simulated time (s); the plan's start at first."""
        return self._start + self._tick * self._dt

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by; assign others at any time."""
        return self.walker.plan

    @plan.setter
    def plan(self, plan: FootstepPlan) -> None:
        self.walker.plan = plan

    @property
    def fallen(self) -> bool:
        """Whether the robot has fallen or its controller has stopped."""
        return self._fall is not None

    @property
    def finished(self) -> bool:
        """Whether the plan is walked and the robot has stood for a while after it, or it fell."""
        return self.fallen or self._interrupted or self.time >= self._end - 1e-9

    @property
    def _end(self) -> float:
        """Time (s) at which a run ends of its own, as far as is known now."""
        scheduled = self._schedule[-1][0] if self._schedule else -np.inf
        return max(self.plan.end, scheduled) + STAND_AFTER

    def command(self, vx: float, vy: float, wz: float) -> None:
        """Walk at this velocity from now on, until another command; zeros stop the walk.

        `vx` (forward) and `vy` (left) in m/s, `wz` (yaw rate, left positive) in rad/s, in the
        frame of the walking robot; scaled down to what its legs can do. It holds until the next
        command; the plan of every instant ends in a stand. May be called at any moment.

        Raises:
            InvalidInput: a number is not finite.
        """
        saturated((vx, vy, wz), self.limits)  # refuses what cannot be before anything changes
        self._command = (vx, vy, wz)
        self._obey()

    def schedule(self, commands: Sequence[tuple[Command, float]]) -> None:
        """Give these commands one after the other from now on, each for its duration; then stop.

        Args:
            commands: pairs of a command (vx, vy, wz), as for `command`, and its duration (s).

        Raises:
            InvalidInput: a number is not finite, or a duration is not > 0.
        """
        t, times = self.time, []
        for command, duration in commands:
            if not (np.isfinite(duration) and duration > 0.0):
                raise InvalidInput(
                    f"duration must be finite and > 0 s, got {duration}.", argument="duration"
                )
            saturated(command, self.limits)
            times.append((t, command))
            t += duration
        self._schedule = [*times, (t, (0.0, 0.0, 0.0))]

    def _obey(self) -> None:
        """Plan on along the command in force; again at every lift, so that the plan never ends."""
        t = self.time
        plan = follow_velocity(self.plan, t, self._command, self.limits)
        if plan is not self.plan:
            self.plan = plan.since(t - FORGET)
        going = any(self._command)
        lift = next((step.lift for step in self.plan.steps if step.lift > t), t)
        self._obey_at = lift + 0.5 * self._dt if going else np.inf

    def run(self, until: float | None = None, progress: Progress | None = None) -> Walk:
        """Go on to time `until` (s; default: until it has stood for a while after the plan).

        Ends early at a fall; Ctrl-C ends it too and is noted in the record.

        Raises:
            InvalidInput: no `until` while a command is in force, which would be a walk for ever.
        """
        if until is None and any(self._command) and not self._schedule:
            raise InvalidInput(
                "until must be given while a command is in force, "
                f"got a walk at {self._command} for ever; command(0, 0, 0) stops it."
            )
        try:
            with one_thread():
                while not (self.fallen or self._interrupted):
                    end = self._end if until is None else until
                    if self.time >= end - 1e-9:
                        break
                    self.tick()
                    if progress is not None and self._tick % 25 == 0:
                        progress(self.time, end)
        except KeyboardInterrupt:
            self._interrupted = True
        return self

    def tick(self) -> None:
        """Do one control tick: sense, compute torques, record, step the physics."""
        start = perf_counter()
        t, world, walker = self.time, self.world, self.walker
        while self._schedule and t >= self._schedule[0][0] - 1e-9:
            self.command(*self._schedule.pop(0)[1])
        if t >= self._obey_at:
            self._obey()
        world.sense()
        before = perf_counter()
        try:
            torques = walker.tick(
                t, world.q, world.v, {foot: float(world.wrench[foot][2]) for foot in FEET}
            )
        except PreviewWalkError as stop:
            self._fall = (t, str(stop))
            return
        spent = perf_counter() - before
        self._recorder.plan(t, walker.plan)
        self._recorder.write(**tick_row(t, world, walker, torques, spent))
        self._check_fall(t)
        world.step(torques, self._substeps)
        self._tick += 1
        self._wall += perf_counter() - start

    def record(self, **settings: Any) -> Record:
        """Return the record of the run so far."""
        time, reason = self._fall if self._fall else (None, None)
        return self._recorder.finish(
            fell=self.fallen,
            fall_time=time,
            fall_reason=reason,
            interrupted=self._interrupted,
            wall_time=self._wall,
            **settings,
        )

    def _check_fall(self, t: float) -> None:
        dynamics = self.walker.body.dynamics
        # The lower foot is on the ground; the other one may be flung up by a recovery step.
        ground = min(dynamics.soles[foot].position[2] for foot in FEET)
        height = float(dynamics.com[2] - ground)
        tilt = float(np.arccos(np.clip(dynamics.torso.rotation[2, 2], -1.0, 1.0)))
        if height < FALL_HEIGHT * self.robot.com_height:
            low = f"{height:.2f} m of {self.robot.com_height:.2f} m"
            self._fall = (t, f"the CoM sank to {low} above the feet")
        elif tilt > FALL_TILT:
            self._fall = (t, f"the torso leaned {np.degrees(tilt):.0f} degrees")
