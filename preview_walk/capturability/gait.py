"""The gait that a push hits: its limits, its DCM at the push and the strides it has left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from math import exp, expm1, inf

import numpy as np

from preview_walk.arguments import finite_number, instance_of, number_from_zero, positive_number
from preview_walk.capturability.program import CaptureStep, Polygon
from preview_walk.errors import InvalidInput
from preview_walk.geometry.support import Sole
from preview_walk.preview.cart_table import natural_frequency
from preview_walk.types import Array

_CHECKED_APART = ("sole", "step_length", "double_support", "short_double_support")
"""Fields that need not be positive."""


@dataclass(frozen=True, kw_only=True)
class PushGait:
    """A robot as a linear inverted pendulum, its straight walk, and what its legs can do.

    Attributes:
        mass: of the whole robot, kg.
        com_height: constant height of the CoM above the soles, m.
        sole: half sizes of the soles.
        step_width: lateral distance of the sole centres, m.
        step_length: how far each foot lands ahead of the other, m; negative walks backwards.
        single_support: duration of single support, s.
        double_support: duration of double support, s.
        forward: a foot lands at most this far ahead of the standing one, m.
        backward: and at most this far behind it, m.
        min_width: least lateral distance of the sole centres (no crossing of the legs), m.
        max_width: largest lateral distance of the sole centres, m.
        min_swing_time: shortest single support, s.
        max_swing_time: longest single support, s.
        swing_speed: largest mean speed of the swing foot over the rest of its way, m/s.
        short_double_support: duration of double support in an answer whose times are free, s; None
            keeps that of the walk.

    Raises:
        InvalidInput: a number that is not finite or out of range, or a gait beyond its limits.
    """

    mass: float
    com_height: float
    sole: Sole = field(default_factory=Sole)
    step_width: float
    step_length: float
    single_support: float
    double_support: float
    forward: float
    backward: float
    min_width: float
    max_width: float
    min_swing_time: float
    max_swing_time: float
    swing_speed: float
    short_double_support: float | None = None

    def __post_init__(self) -> None:
        """Check the numbers."""
        instance_of(self.sole, Sole, "sole")
        for item in fields(self):
            if item.name not in _CHECKED_APART:
                value = positive_number(getattr(self, item.name), item.name, _unit(item.name))
                object.__setattr__(self, item.name, value)
        finite_number(self.step_length, "step_length", "m")
        number_from_zero(self.double_support, "double_support", "s")
        if self.short_double_support is not None:
            number_from_zero(self.short_double_support, "short_double_support", "s")
        for name, low, high in (
            ("step_length", -self.backward, self.forward),
            ("step_width", self.min_width, self.max_width),
            ("single_support", self.min_swing_time, self.max_swing_time),
        ):
            value = getattr(self, name)
            if not low <= value <= high:
                raise InvalidInput(
                    f"{name} must be between {low} and {high}, the limits of a step, got {value}.",
                    argument=name,
                )

    @property
    def omega(self) -> float:
        """Natural frequency sqrt(g / z) of the pendulum, 1/s."""
        return natural_frequency(self.com_height)

    def impulse(self, jump: float, duration: float) -> float:
        """Return the impulse (N·s) of a constant force that moves the DCM like a jump (m).

        Args:
            jump: of the DCM at the first instant of the push (m).
            duration: of the force (s).
        """
        omega = self.omega
        return self.mass * omega * jump * omega * duration / -expm1(-omega * duration)

    def step(self, index: int) -> Array:
        """Return the `index`-th nominal stride after the push, (2,) m; y towards the stance foot.

        The foot that swings at the push lands first, at -step_width.
        """
        return np.array([self.step_length, self.step_width * (1.0 if index % 2 else -1.0)])

    def swing_foot(self, share: float | None) -> Array:
        """Return where the foot that swings first is, (2,) m relative to the stance foot.

        Args:
            share: of single support that is over; None: standing.
        """
        if share is None:
            return np.array([0.0, -self.step_width])
        way = 2.0 * share * share * (3.0 - 2.0 * share) - 1.0
        return np.array([way * self.step_length, -self.step_width])

    def dcm(self, share: float | None) -> Array:
        """Return the nominal DCM, (2,) m relative to the stance foot.

        Let d be the next stride and xi the DCM at the beginning of single support. Over one step
        the DCM repeats relative to the stance foot, forward as it is and sideways mirrored. With
        the CoP at 0, then moving from 0 to d in double support T_d, then the next step,

            xi = exp(-omega T_s) (w d + exp(-omega T_d) (d + (xi_x, -xi_y))),
            w = (1 - exp(-omega T_d)) / (omega T_d) - exp(-omega T_d),

        where w is the discounted mean of the way of the CoP; within single support xi grows as
        exp(omega t) (Englsberger et al. 2015, the DCM under a ZMP that is held).

        Args:
            share: of single support that is over; None: standing, midway between the soles.
        """
        stride = self.step(0)
        if share is None:
            return np.array([0.0, 0.5 * stride[1]])
        shift = self.omega * self.double_support
        single, double = exp(-self.omega * self.single_support), exp(-shift)
        moving = -expm1(-shift) / shift - double if shift > 0.0 else 0.0
        repeats = 1.0 - single * double * np.array([1.0, -1.0])
        start: Array = single * (moving + double) * stride / repeats
        return start * exp(self.omega * self.single_support * share)

    def strides(
        self,
        share: float | None,
        delay: float,
        singles: Sequence[float],
        kept: bool = False,
        pause: float | None = None,
    ) -> list[CaptureStep]:
        """Return what the strides after the push may be, if they keep to these times.

        Who stands is in double support for a while first. That contributes like a stride back to
        the foot that will swing, whose weight is free between 0 and 1 - exp(-omega delay).

        Args:
            share: of single support that is over; None: standing.
            delay: from the push until the first foot lifts, s; infinite for one who only stands.
                Not used in single support.
            singles: (n,) how long each foot stays in the air from then or from the push on, s.
            kept: whether the footholds stay those of the plan.
            pause: duration of the double supports, s; None: as in the walk.
        """
        pause = self.double_support if pause is None else pause
        strides, time = [], 0.0
        place = self.swing_foot(share)
        if share is None:
            strides.append(CaptureStep(-expm1(-self.omega * delay), 0.0, Polygon.point(place)))
            time = delay
        for index, single in enumerate(singles):
            time += single
            step = self.step(index)
            reach = Polygon.point(step) if kept else self._reach(step)
            if index == 0 and not kept:
                reach &= Polygon.disc(place, self.swing_speed * single)
            last = index == len(singles) - 1
            strides.append(
                CaptureStep(
                    most=exp(-self.omega * time),
                    least=0.0 if last else exp(-self.omega * pause),
                    reach=reach,
                    travel=inf if kept or index == 0 else self.swing_speed * single,
                )
            )
            time += pause
        return strides

    def _reach(self, step: Array) -> Polygon:
        """Return where the foot may land that makes the step (2,), relative to the other foot."""
        side = 1.0 if step[1] > 0.0 else -1.0
        return Polygon.box(
            (-self.backward, self.forward), (side * self.min_width, side * self.max_width)
        )


def _unit(name: str) -> str:
    """Return the unit of a field."""
    if name.endswith(("_support", "_time")):
        return "s"
    return {"mass": "kg", "swing_speed": "m/s"}.get(name, "m")
