"""What a robot's legs can do: where a sole may be put beside the standing one, and how fast."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from math import cos, isfinite, sin, sqrt

from preview_walk.constants import GRAVITY
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import Heading, compose, heading_of, pose_at, relative
from preview_walk.geometry.support import Sole, sole_gap
from preview_walk.types import Array, Foot, other

_TOLERANCE = 1e-6
_TRIES = 60
_ON_THE_WAY = (0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9)


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

    def __post_init__(self) -> None:
        """Check the bounds."""
        for bound in fields(self)[1:]:
            value = getattr(self, bound.name)
            if not (isfinite(value) and value > 0.0):
                raise InvalidInput(f"{bound.name} must be finite and > 0, got {value}.")
        if not self.min_width <= self.step_width <= self.max_width:
            raise InvalidInput(
                "step_width must be between min_width and max_width, got "
                f"{self.min_width} <= {self.step_width} <= {self.max_width} m."
            )
        if not 0.5 * self.slow_step_time < self.fast_step_time <= self.slow_step_time:
            raise InvalidInput(
                "fast_step_time must be more than half of slow_step_time and not longer, "
                f"got {self.fast_step_time} s and {self.slow_step_time} s."
            )
        if max(self.slow_double_support, self.fast_double_support) >= 1.0:
            raise InvalidInput(
                "double support must be a share of the step time in (0, 1), "
                f"got {self.slow_double_support} and {self.fast_double_support}."
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
        for name, value in (("leg_length", leg_length), ("step_width", step_width)):
            if not (isfinite(value) and value > 0.0):
                raise InvalidInput(f"{name} must be > 0 m, got {value}.")
        sole = Sole() if sole is None else sole
        clearance = 0.01
        narrow = 2.0 * sole.half_width + clearance
        if narrow > step_width + _TOLERANCE:
            raise InvalidInput(
                f"a step_width of {step_width} m is too narrow for soles {2 * sole.half_width} m "
                f"wide with {clearance} m between them."
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
        """Return the middle of a stance of nominal width with one sole here."""
        half = 0.5 * self.step_width
        return compose(sole, 0.0, -half if foot == "left" else half)

    def problem(self, foot: Foot, stance: Array, pose: Array) -> str | None:
        """Return what is wrong with landing `foot` at `pose` beside `stance`, or None.

        Args:
            foot: the landing foot.
            stance: pose (4, 4) of the standing sole.
            pose: pose (4, 4) of the landing sole.
        """
        a, b = heading_of(stance), heading_of(pose)
        x, y, turn = relative(a, b)
        side = 1.0 if foot == "left" else -1.0
        height = abs(float(pose[2, 3] - stance[2, 3]))
        beside = f"the {other(foot)} sole"
        for excess, bound, text in (
            (x, self.forward, f"lands {x:.3f} m ahead of {beside}, at most"),
            (-x, self.backward, f"lands {-x:.3f} m behind {beside}, at most"),
            (side * y, self.max_width, f"lands {side * y:.3f} m beside {beside}, at most"),
            (side * turn, self.turn_out, f"turns {side * turn:.3f} rad out from {beside}, at most"),
            (-side * turn, self.turn_in, f"turns {-side * turn:.3f} rad in to {beside}, at most"),
            (height, self.rise, f"lands {height:.3f} m higher or lower than {beside}, at most"),
            (-side * y, -self.min_width, f"lands {side * y:.3f} m beside {beside}, at least"),
        ):
            if excess > bound + _TOLERANCE:
                unit = "rad" if "rad" in text else "m"
                return f"{text} {abs(bound):.3f} {unit} is allowed"
        gap = sole_gap(a, b, self.sole)
        if gap < self.clearance - _TOLERANCE:
            state = f"collides with {beside} (overlap {-gap:.3f} m)"
            if gap >= 0.0:
                state = f"passes {gap:.3f} m from {beside}"
            return f"{state}, at least {self.clearance:.3f} m must stay free"
        return None

    def crossing(self, foot: Foot, stance: Heading, start: Heading, landing: Heading) -> str | None:
        """Return what is wrong with swinging straight from `start` to `landing`, or None.

        Args:
            foot: the swinging foot.
            stance: heading of the standing sole.
            start: heading of the swinging sole at lift.
            landing: heading of the swinging sole at landing.
        """
        overlap = -self._sweep(stance, start, landing)
        if overlap <= _TOLERANCE:
            return None
        return f"swings across the {other(foot)} sole (overlap {overlap:.3f} m)"

    def checked(
        self, number: int, foot: Foot, stance: Array, start: Array, pose: Array, shorten: bool
    ) -> Array:
        """Return the landing pose (4, 4) of step `number` if it is allowed.

        Args:
            number: of the step, for the message.
            foot: the landing foot.
            stance: pose (4, 4) of the standing sole.
            start: pose (4, 4) of the swinging sole at lift.
            pose: pose (4, 4) of the swinging sole at landing.
            shorten: return the nearest allowed level pose instead of refusing.

        Raises:
            InvalidInput: the step breaks a limit.
        """
        here, begin, end = heading_of(stance), heading_of(start), heading_of(pose)
        problem = self.problem(foot, stance, pose) or self.crossing(foot, here, begin, end)
        if problem is None:
            return pose
        if not shorten:
            raise InvalidInput(f"step {number} {problem}.")
        return pose_at(*self.clamp(foot, here, end, begin), float(pose[2, 3]))

    def _sweep(self, stance: Heading, start: Heading, landing: Heading) -> float:
        """Return the least gap (m) on the way."""
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
        """
        x, y, turn = relative(stance, goal)
        side = 1.0 if foot == "left" else -1.0
        x_in = min(self.forward, max(-self.backward, x))
        width = min(self.max_width, max(self.min_width, side * y))
        turn_in = side * min(self.turn_out, max(-self.turn_in, side * turn))
        inside = abs(x - x_in) + abs(side * y - width) + abs(turn - turn_in) < _TOLERANCE
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
        if sole_gap(stance, landing, self.sole) < self.clearance - _TOLERANCE:
            return False
        if start is not None and self._sweep(stance, start, landing) < 0.0:
            return False
        # The other foot stands beside the track of this one: it will pass it.
        _, y, turn = relative(landing, stance)
        track = self.sole.half_width * (1.0 + cos(turn)) + self.sole.half_length * abs(sin(turn))
        return -side * y >= min(track, self.min_width) - _TOLERANCE
