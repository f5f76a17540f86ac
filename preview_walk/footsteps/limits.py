"""What a robot's legs can do: where a sole may be put beside the standing one, and how fast."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from math import cos, sin, sqrt

from preview_walk.arguments import foot_of, instance_of, positive_number, share_of
from preview_walk.constants import GRAVITY
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.motors import Motors
from preview_walk.footsteps.step_problem import (
    ROUNDING,
    StepProblem,
    crossing_problem,
    landing_problem,
)
from preview_walk.geometry.poses import (
    Heading,
    as_pose,
    compose,
    heading_of,
    pose_at,
    relative,
)
from preview_walk.geometry.support import Sole, sole_gap
from preview_walk.types import Array, Foot

_SIDE = {"left": 1.0, "right": -1.0}
"""The direction along y in which a foot stands beside the other one."""

_TRIES = 60
"""A step is widened at most this many times, by 1 cm each, until it is clear of the other sole."""

_ON_THE_WAY = (0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9)
"""Shares of a swing's way at which its sole is looked at."""

_UNITS = {
    **dict.fromkeys(("turn_out", "turn_in"), "rad"),
    **dict.fromkeys(("min_swing_time", "slow_step_time", "fast_step_time"), "s"),
    **dict.fromkeys(("slow_double_support", "fast_double_support"), ""),
    "speed_change": "m/s",
}
"""Units of the bounds that are no lengths."""


@dataclass(frozen=True)
class GaitLimits:
    """Bounds of one step, all of the landing sole seen in the frame of the standing sole.

    Attributes:
        sole: half sizes of the soles.
        step_width: lateral distance of the sole centres in a straight walk, m.
        forward: the landing sole is at most this far ahead of the standing one, m.
        backward: and at most this far behind it, m.
        min_width: least lateral distance of the sole centres, m.
        max_width: largest lateral distance of the sole centres, m.
        turn_out: largest yaw of the landing sole away from the standing one (toes out), rad.
        turn_in: largest yaw of the landing sole towards the standing one (toes in), rad.
        rise: largest height difference of the two soles, m.
        clearance: least gap between the two sole rectangles, m.
        min_swing_time: shortest time in the air, s.
        slow_step_time: step time at the lowest speeds, s; chosen for velocity commands.
        fast_step_time: step time at full speed, s; more than half of the slow one.
        slow_double_support: share of double support in the step time at the lowest speeds.
        fast_double_support: the same at full speed.
        speed_change: largest change of the forward speed from one step to the next, m/s.
        motors: whether motors and joint speeds are enough for a plan's steps; None: not looked at.

    Raises:
        InvalidInput: a bound that is not finite and positive, or two that exclude each other.
    """

    sole: Sole = field(default_factory=Sole)
    step_width: float = 0.2
    forward: float = 0.5
    backward: float = 0.3
    min_width: float = 0.12
    max_width: float = 0.4
    turn_out: float = 0.5
    turn_in: float = 0.2
    rise: float = 0.2
    clearance: float = 0.01
    min_swing_time: float = 0.25
    slow_step_time: float = 0.7
    fast_step_time: float = 0.6
    slow_double_support: float = 0.2
    fast_double_support: float = 0.05
    speed_change: float = 0.15
    motors: Motors | None = field(default=None, compare=False, kw_only=True)

    def __post_init__(self) -> None:
        """Check the bounds."""
        instance_of(self.sole, Sole, "sole")
        for bound in fields(self)[1:-1]:
            unit = _UNITS.get(bound.name, "m")
            size = positive_number(getattr(self, bound.name), bound.name, unit)
            object.__setattr__(self, bound.name, size)
        if not self.min_width <= self.step_width <= self.max_width:
            raise InvalidInput(
                "step_width must be between min_width and max_width, got "
                f"{self.min_width} <= {self.step_width} <= {self.max_width} m.",
                argument="step_width",
            )
        if not 0.5 * self.slow_step_time < self.fast_step_time <= self.slow_step_time:
            raise InvalidInput(
                "fast_step_time must be more than half of slow_step_time and not longer, "
                f"got {self.fast_step_time} s and {self.slow_step_time} s.",
                argument="fast_step_time",
            )
        for name in ("slow_double_support", "fast_double_support"):
            share_of(getattr(self, name), name, "the step time")

    def __repr__(self) -> str:
        return (
            f"GaitLimits({self.forward:.3f} m forward, {self.backward:.3f} m backward, "
            f"{self.min_width:.3f} to {self.max_width:.3f} m wide, "
            f"{self.turn_out:.3f} rad out, {self.turn_in:.3f} rad in)"
        )

    @classmethod
    def for_leg(cls, leg_length: float, step_width: float, sole: Sole | None = None) -> GaitLimits:
        """Return limits in proportion to the leg, for a robot nobody has tuned.

        The step times scale with the pendulum time sqrt(leg_length / g), as in dynamically
        similar walks (Alexander, Hof); a leg of 0.85 m gets 0.70 s slow and 0.60 s fast.

        Args:
            leg_length: from hip to sole with the leg straight, m.
            step_width: lateral distance of the sole centres when standing, m.
            sole: half sizes of the soles.

        Raises:
            InvalidInput: a length is not finite and positive, or the soles do not fit the width.
        """
        leg_length = positive_number(leg_length, "leg_length", "m")
        step_width = positive_number(step_width, "step_width", "m")
        sole = Sole() if sole is None else instance_of(sole, Sole, "sole")
        clearance = 0.01
        narrow = 2.0 * sole.half_width + clearance
        if narrow > step_width + ROUNDING:
            raise InvalidInput(
                f"a step_width of {step_width} m is too narrow for soles {2 * sole.half_width} m "
                f"wide with {clearance} m between them.",
                argument="step_width",
            )
        pendulum = sqrt(leg_length / GRAVITY)
        return cls(
            sole=sole,
            step_width=step_width,
            forward=0.75 * leg_length,
            backward=0.4 * leg_length,
            min_width=min(narrow, step_width),
            max_width=step_width + 0.25 * leg_length,
            rise=0.25 * leg_length,
            clearance=clearance,
            min_swing_time=0.85 * pendulum,
            slow_step_time=2.38 * pendulum,
            fast_step_time=2.04 * pendulum,
            speed_change=0.52 * sqrt(GRAVITY * leg_length) / 10.0,
        )

    def centre(self, foot: Foot, sole: Heading) -> Heading:
        """Return the middle of a stance of nominal width.

        Args:
            foot: the foot whose sole is known.
            sole: heading of that sole.
        """
        half = 0.5 * self.step_width
        return compose(sole, 0.0, -half if foot == "left" else half)

    def problem(self, foot: Foot, stance: Array, pose: Array) -> StepProblem | None:
        """Return what is wrong with landing `foot` at `pose` beside `stance`, or None.

        Args:
            foot: the landing foot.
            stance: pose (4, 4) of the standing sole.
            pose: pose (4, 4) of the landing sole.

        Raises:
            InvalidInput: no foot, or no pose.
        """
        _side(foot)
        a, b = heading_of(as_pose(stance, "stance")), heading_of(as_pose(pose, "pose"))
        rise = abs(float(pose[2, 3] - stance[2, 3]))
        return landing_problem(self, foot, relative(a, b), rise, sole_gap(a, b, self.sole))

    def crossing(self, foot: Foot, stance: Array, start: Array, pose: Array) -> StepProblem | None:
        """Return what is wrong with swinging straight from `start` to `pose`, or None.

        Args:
            foot: the swinging foot.
            stance: pose (4, 4) of the standing sole.
            start: pose (4, 4) of the swinging sole at lift.
            pose: pose (4, 4) of the swinging sole at landing.

        Raises:
            InvalidInput: no foot, or no pose.
        """
        _side(foot)
        here, begin, end = heading_of(stance), heading_of(start), heading_of(pose)
        overlap = -self._sweep(here, begin, end)
        if overlap <= ROUNDING:
            return None
        return crossing_problem(foot, overlap, relative(here, end)[2])

    def shortened(self, foot: Foot, stance: Array, start: Array, pose: Array) -> Array:
        """Return the allowed level pose (4, 4) of the landing sole nearest to `pose`.

        Arguments as in `crossing`.
        """
        goal, begin = heading_of(pose), heading_of(start)
        return pose_at(*self.clamp(foot, heading_of(stance), goal, begin), float(pose[2, 3]))

    def _sweep(self, stance: Heading, start: Heading, landing: Heading) -> float:
        """Return the least gap (m) between the soles on the way."""
        dx, dy, turn = relative(start, landing)
        way = (compose(start, s * dx, s * dy, s * turn) for s in _ON_THE_WAY)
        return min(sole_gap(stance, sole, self.sole) for sole in way)

    def clamp(
        self, foot: Foot, stance: Heading, goal: Heading, start: Heading | None = None
    ) -> Heading:
        """Return the allowed heading of the landing sole that is near `goal`.

        Each coordinate is cut to its bound; then the step is widened (and turned less) until the
        soles are clear of each other, on the way too, and until the other foot can follow
        straight past this one.

        Args:
            foot: the landing foot.
            stance: heading of the standing sole.
            goal: heading where the sole would land without limits.
            start: heading from which the foot swings; None leaves the way unchecked.

        Raises:
            InvalidInput: no foot, or no heading.
        """
        x, y, turn = relative(stance, goal)
        side = _side(foot)
        x_in = min(self.forward, max(-self.backward, x))
        width = min(self.max_width, max(self.min_width, side * y))
        turn_in = side * min(self.turn_out, max(-self.turn_in, side * turn))
        inside = abs(x - x_in) + abs(side * y - width) + abs(turn - turn_in) < ROUNDING
        # Left alone where nothing is out of bounds, so that allowed steps stay bit for bit.
        landing = goal if inside else compose(stance, x_in, side * width, turn_in)
        for _ in range(_TRIES):
            if self._clear(side, stance, landing, start):
                break
            if width >= self.max_width:
                turn_in *= 0.5
            width = min(self.max_width, width + 0.01)
            landing = compose(stance, x_in, side * width, turn_in)
        return landing

    def _clear(self, side: float, stance: Heading, landing: Heading, start: Heading | None) -> bool:
        """Return whether a landing leaves room, on the way and for the next step, too."""
        if sole_gap(stance, landing, self.sole) < self.clearance - ROUNDING:
            return False
        if start is not None and self._sweep(stance, start, landing) < 0.0:
            return False
        # The other foot stands beside the track of this one: it will pass it.
        _, y, turn = relative(landing, stance)
        track = self.sole.half_width * (1.0 + cos(turn)) + self.sole.half_length * abs(sin(turn))
        return -side * y >= min(track, self.min_width) - ROUNDING


def _side(foot: Foot) -> float:
    """Return 1 for the left foot, -1 for the right one."""
    try:
        return _SIDE[foot]
    except (KeyError, TypeError):
        return _SIDE[foot_of(foot, "foot")]
