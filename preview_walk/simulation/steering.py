"""What may be asked of a walk under way: velocities, plans, pushes, gains; by any thread."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from preview_walk.arguments import finite_number, instance_of
from preview_walk.controller.walker import Walker
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.simulation.commands import Command, VelocityCommands
from preview_walk.simulation.plant import Plant
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.rates import require_rates
from preview_walk.simulation.requests import Requests
from preview_walk.simulation.scene import Scene
from preview_walk.simulation.world import World
from preview_walk.tracking.gains import TrackingGains


class Steered:
    """What a `Walk` is asked for under way.

    Assign `plan` or `gains`, or call `command`, `schedule` or `push`, at any moment and from any
    thread: what comes while a tick is under way is taken at the next one.
    """

    plant: Plant
    walker: Walker
    _start: float
    _tick: int
    _dt: float
    _commands: VelocityCommands
    _requests: Requests
    _fall: tuple[float, str] | None
    _retuned: list[dict[str, Any]]

    @property
    def time(self) -> float:
        """Simulated time (s); the plan's start at first."""
        return self._start + self._tick * self._dt

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by; assign others at any time, in any form that `as_plan` reads.

        They must begin where the feet are and be in reach of the legs: else `InvalidInput` is
        raised, and the old plan goes on.
        """
        return self.walker.plan

    @plan.setter
    def plan(self, plan: PlanLike) -> None:
        new = as_plan(plan)
        self._take(lambda: self.walker.change(new, self.time))

    @property
    def gains(self) -> TrackingGains:
        """Weights and gains of the tracker; assign others at any time.

        The record has those of the beginning in `run.gains` and what came later in `run.retuned`.
        Gains that are too fast for the ticks raise `InvalidInput`, and the old ones stay.
        """
        return self.walker.gains

    @gains.setter
    def gains(self, gains: TrackingGains) -> None:
        instance_of(gains, TrackingGains, "gains")
        require_rates(1.0 / self.plant.timestep, 1.0 / self._dt, gains)

        def tune() -> None:
            self.walker.tune(gains)
            self._retuned.append({"t": self.time, "gains": asdict(gains)})

        self._take(tune)

    @property
    def commanded(self) -> Command:
        """The velocity command in force: vx, vy (m/s), yaw rate (rad/s); zeros where none is."""
        return self._commands.current

    def command(self, vx: float, vy: float, wz: float) -> None:
        """Walk at this velocity from now on, until another command; zeros stop the walk.

        It is scaled down to what the robot's legs can do. The plan of every instant ends in a
        stand.

        Args:
            vx: forward, m/s, in the frame of the walking robot; so are the others.
            vy: to the left, m/s.
            wz: yaw rate to the left, rad/s.

        Raises:
            InvalidInput: a number is not finite, or the robot has fallen.
        """
        vx, vy = finite_number(vx, "vx", "m/s"), finite_number(vy, "vy", "m/s")
        wz = finite_number(wz, "wz", "rad/s")

        def give() -> None:
            self._commands.give(self.time, (vx, vy, wz))
            self._obey()

        self._take(give)

    def schedule(self, commands: Sequence[tuple[Command, float]]) -> None:
        """Give these commands one after the other from now on, each for its duration; then stop.

        Args:
            commands: pairs of a command (vx, vy, wz), as for `command`, and its duration (s).

        Raises:
            InvalidInput: a number is not finite, a duration is not > 0, or the robot has fallen.
        """
        self._take(lambda: self._commands.schedule(self.time, commands))

    def push(
        self, force: tuple[float, float, float], duration: float, body: str | None = None
    ) -> None:
        """Push the robot from now on; the record has the push in `run.pushes`, as all others.

        Args:
            force: (x, y, z) in newtons, world axes.
            duration: how long it lasts, s; the impulse is force times duration.
            body: name of the body pushed; None is the base, a humanoid's pelvis.

        Raises:
            InvalidInput: a value that cannot be, an unknown body, a plant that is not in MuJoCo, or
                the robot has fallen.
        """
        plant = self.plant
        if not isinstance(plant, World | Scene):
            raise InvalidInput("push needs a walk in MuJoCo; push a plant of one's own oneself.")
        Push(0.0, duration, force, body)  # what cannot be is told at once, not at the next tick
        self._take(lambda: plant.add_push(Push(max(self.time, 0.0), duration, force, body)))

    def _take(self, request: Callable[[], None]) -> None:
        """Do what is asked, now or at the next tick, unless the robot has fallen."""
        if self._fall is not None:
            raise InvalidInput(
                f"the robot fell at {self._fall[0]:.2f} s: {self._fall[1]}; make another walk."
            )
        self._requests.do(request)

    def _obey(self) -> None:
        """Walk by the plan that the commands ask for now."""
        plan = self._commands.plan(self.time, self.plan)
        if plan is not None:
            self.walker.follow(self.walker.laid(plan))
