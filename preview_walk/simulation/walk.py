"""A walk: the loop that senses a plant, ticks the controller, records, and lets the plant step."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from time import perf_counter
from typing import Any

from preview_walk.arguments import (
    LARGEST_SEED,
    count_of,
    finite_number,
    function_of,
    instance_of,
)
from preview_walk.controller.robot_limits import command_limits
from preview_walk.errors import PreviewWalkError
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.reality.realism import Realism
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.commands import VelocityCommands
from preview_walk.simulation.fall import fall_reason, over_edges
from preview_walk.simulation.plant import Plant
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.rates import require_rates, steps_per_tick
from preview_walk.simulation.recording import WalkRecorder
from preview_walk.simulation.requests import Requests
from preview_walk.simulation.seeing import sight_of
from preview_walk.simulation.standing import plant_of, stand, standing_plan
from preview_walk.simulation.steering import Steered
from preview_walk.terrain.ground import Ground
from preview_walk.threads import one_thread
from preview_walk.tracking.gains import TrackingGains
from preview_walk.types import FEET

CONTROL_HZ = 500
"""Default ticks of the controller per second."""

STAND_AFTER = 1.0
"""Time (s) that a run goes on after the plan's end, standing."""

Progress = Callable[[float, float], None]
"""Called now and then with the simulated time and its end (s)."""

_ROUNDING = 1e-9
_ATTRIBUTES = ("robot", "plant", "walker", "plan", "gains")


class Walk(Steered):
    """A running walk; `simulate` and `simulate_commands` are the short ways.

    What may be asked of it under way, by any thread, stands at `Steered`. A walk pickles and
    copies; the copy goes on bit for bit as the original does.

    Attributes:
        robot, plant: the robot that walks, and what is sensed and driven.
        walker: the controller.
    """

    def __init__(
        self,
        robot: Robot | Plant,
        plan: PlanLike,
        *,
        physics_hz: int | None = None,
        control_hz: float = CONTROL_HZ,
        friction: float | None = None,
        pushes: Sequence[Push] | None = None,
        seed: int = 0,
        gains: TrackingGains | None = None,
        solver: str = "osqp",
        swing_height: float | None = None,
        com_height: float | None = None,
        com_generator: str = "preview",
        on_tick: Callable[[Walk], None] | None = None,
        visuals: bool | None = None,
        ground: Ground | None = None,
        blind: bool = False,
        realism: Realism | None = None,
        record_hz: float | None = None,
        blocks: str | os.PathLike[str] | None = None,
    ) -> None:
        """Stand the robot on the plan's first soles.

        Args:
            robot: from `load_robot`, to walk in the project's own world; or a plant (a `Scene`, or
                one's own), which has its physics, friction, pushes and robot already.
            plan: the footsteps, in any form that `as_plan` reads.
            physics_hz: steps of the physics per second, a multiple of control_hz; None: 1000.
            control_hz: ticks of the controller per second.
            friction: Coulomb friction between soles and floor, known to the controller; None: 0.8.
            pushes: forces on the robot's bodies; None: none.
            seed: seeds whatever is random in the run; kept with the record.
            gains: weights and gains of the tracker; None takes the defaults.
            solver: "osqp", "daqp" or another backend of qpsolvers.
            swing_height: of a swing's apex above the higher of its two soles, m; None: by the leg.
            com_height: of the CoM above the soles while standing, m; None: as in the posture.
            com_generator: what leads the CoM: "preview" control, the ZMP "mpc" or the "dcm".
            on_tick: called with the walk at the end of every tick, before the physics steps.
            visuals: run on the model with visual meshes, for the live viewer.
            ground: what the robot stands on; None is level. All plans are laid on it (`lay_on`).
            blind: whether the walker takes the ground for level, whatever it is, and feels its way.
            realism: what is not perfect about sensors, motors and model; None: nothing.
            record_hz: rows of the record per second, control_hz over a whole number; None: one at
                every tick. What a summary says of ticks is then of those that have a row.
            blocks: folder that the record is written to as the walk goes, a block every 5 s, so
                that a killed process leaves it (`Record.load` reads the folder); None: none.

        Raises:
            InvalidInput: a value that cannot be, a plan on which the robot cannot stand, or beside
                a plant a setting that is the plant's own.
        """
        plan = as_plan(plan)
        own = {"physics_hz": physics_hz, "friction": friction, "pushes": pushes, "visuals": visuals}
        seed = count_of(seed, "seed", LARGEST_SEED)
        self.plant = plant_of(robot, com_height, realism, seed, ground=ground, **own)
        self.robot = self.plant.robot
        gains = TrackingGains() if gains is None else instance_of(gains, TrackingGains, "gains")
        rate = 1.0 / self.plant.timestep
        self._substeps = steps_per_tick(rate, control_hz)
        require_rates(rate, control_hz, gains)
        self._dt = 1.0 / control_hz
        ways: dict[str, Any] = {"swing_height": swing_height, "com_generator": com_generator}
        self.walker = stand(self.plant, plan, blind is True, gains=gains, solver=solver, **ways)
        self._sight = sight_of(self.plant, self.walker, self._dt)
        self._commands = VelocityCommands(partial(command_limits, self.robot), self._dt)
        self._on_tick = function_of(on_tick, "on_tick")
        self._requests, self._retuned = Requests(), []
        self._start, self._tick, self._wall = plan.start, 0, 0.0
        self._interrupted, self._fall = False, None
        facts: dict[str, Any] = {"control_hz": control_hz, "seed": seed, "solver": solver}
        self._recorder = WalkRecorder(
            self.plant, self.walker, self._sight, record_hz=record_hz, blocks=blocks, **facts
        )

    @classmethod
    def standing(
        cls, robot: Robot | Plant, start: Sequence[float] = (0.0, 0.0), **settings: Any
    ) -> Walk:
        """Return a walk that stands at `start` (x, y[, yaw]; m, rad), to be moved by `command`.

        `settings`: as of `Walk`.
        """
        return cls(robot, standing_plan(robot, start), **settings)

    def __repr__(self) -> str:
        state = "fallen" if self.fallen else f"{len(self.plan.steps)} steps planned"
        return f"Walk({self.robot.name}, {self.time:.3f} s, {state})"

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse what a walk does not have, and would ignore."""
        if not (name.startswith("_") or name in _ATTRIBUTES):
            raise AttributeError(
                f"a Walk has no '{name}'; give settings when it is made, and assign plan."
            )
        object.__setattr__(self, name, value)

    @property
    def limits(self) -> GaitLimits:
        """Bounds of the steps that velocity commands are scaled down to."""
        return command_limits(self.robot)

    @property
    def fallen(self) -> bool:
        """Whether the robot has fallen or its controller has stopped."""
        return self._fall is not None

    @property
    def fall_reason(self) -> str:
        """Why the robot fell, in words; "" while it has not."""
        return "" if self._fall is None else self._fall[1]

    @property
    def interrupted(self) -> bool:
        """Whether the run was ended by Ctrl-C or `interrupt`."""
        return self._interrupted

    @property
    def finished(self) -> bool:
        """Whether the plan is walked and the robot has stood for a while after it, or it fell."""
        return self.fallen or self._interrupted or self.time >= self._end - _ROUNDING

    @property
    def _end(self) -> float:
        """Time (s) at which a run ends of its own, as far as is known now."""
        return max(self.plan.end, self._commands.end) + STAND_AFTER

    def run(self, until: float | None = None, progress: Progress | None = None) -> Walk:
        """Go on to a time, or until the robot has stood for a while after the plan.

        Ends early at a fall; Ctrl-C ends it too and is noted in the record.

        Args:
            until: s; None ends after the plan.
            progress: called now and then with the simulated time and its end (s).

        Raises:
            InvalidInput: `until` is no finite time, or None while a command is in force.
        """
        until = None if until is None else finite_number(until, "until", "s")
        progress = function_of(progress, "progress")
        if until is None:
            self._commands.require_end()
        try:
            with one_thread():
                while not (self.fallen or self._interrupted):
                    end = self._end if until is None else until
                    if self.time >= end - _ROUNDING:
                        break
                    self.tick()
                    if progress is not None and self._tick % 25 == 0:
                        progress(self.time, end)
        except KeyboardInterrupt:
            self.interrupt()
        return self

    def tick(self) -> None:
        """Do one control tick: sense, compute torques, record, step the physics."""
        start = perf_counter()
        with self._requests:
            self._obey()
            t, plant, walker = self.time, self.plant, self.walker
            plant.sense()
            before = perf_counter()
            try:
                seen = self._sight.look(walker)
                torques = walker.tick(t, seen.q, seen.v, seen.wrench, seen.spread)
            except PreviewWalkError as stop:
                self._fall = (t, str(stop))
                return
            self._recorder.write(t, torques, perf_counter() - before)
            reason = fall_reason(walker.body.dynamics, self.robot.com_height)
            if reason is not None:
                soles = {foot: self.plan.sole(foot, t) for foot in FEET}
                self._fall = (t, reason + over_edges(soles, self.robot.sole, plant.ground))
            if self._on_tick is not None:
                self._on_tick(self)
            plant.step(torques, self._substeps)
            self._tick += 1
            self._wall += perf_counter() - start

    def interrupt(self) -> None:
        """End the run here for good, as Ctrl-C does; the record says so."""
        self._interrupted = True

    def record(self) -> Record:
        """Return the record of the run so far."""
        with self._requests:
            return self._recorder.finish(
                self._fall, self._interrupted, wall_time=self._wall, retuned=tuple(self._retuned)
            )
