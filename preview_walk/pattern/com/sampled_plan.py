"""A plan sampled at the planning ticks: the ZMP, the DCM that goes with it, the support."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import Sole
from preview_walk.pattern.com.supports import Supports
from preview_walk.pattern.dcm import planned_dcm
from preview_walk.pattern.swing_moment import swing_zmp_shift
from preview_walk.pattern.walker_model import WalkerModel
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import Array

PLANNING_DT = 0.005
"""Time (s) between two planning ticks: Kajita's T."""

PREVIEW_TIME = 1.6
"""Preview horizon (s): Kajita's 320 samples of 5 ms."""

AHEAD = round(PREVIEW_TIME / PLANNING_DT)
"""Planning ticks that a generator looks ahead."""

SPAN = 800
"""Planning ticks that are sampled at a time, beside those that are looked ahead."""

RENEWAL = SPAN // 2
"""With fewer ticks left of them the next ones are sampled. The ZMP that is not yet sampled moves
the DCM by less than exp(-omega (PREVIEW_TIME + RENEWAL dt)) of itself: some micrometres."""


@dataclass(frozen=True, eq=False)
class SampledPlan:
    """What a plan asks for at the planning ticks from one on; past its end the last sample holds.

    Attributes:
        plan: the footsteps.
        sole: half sizes of the soles.
        first: the planning tick of the first of the M samples.
        times: (M,) s.
        omega: natural frequency of the pendulum, 1/s.
        reference: (M, 2) the ZMP that the plan asks for, m.
        shift: (M, 2) the part of it that the swinging legs' momentum gives, m.
        zmp: (M, 2) the part left for the cart-table, m.
        dcm: (M, 2) the DCM that goes with that ZMP held over each sample, m.
        rest: planning ticks of the plan after the last sample; 0 where all of it is sampled.
    """

    plan: FootstepPlan
    sole: Sole
    first: int
    times: Array
    omega: float
    reference: Array
    shift: Array
    zmp: Array
    dcm: Array
    rest: int

    @cached_property
    def dcm_of_lines(self) -> Array:
        """(M, 2) the DCM (m) that goes with a ZMP that runs straight from sample to sample.

        xi(k) - p(k) = a (xi(k+1) - p(k+1)) + (p(k+1) - p(k)) (1 - a) / (omega T), a =
        exp(-omega T): the same recursion as for a held ZMP, on a mean of neighbouring samples.
        """
        omega_dt = self.omega * PLANNING_DT
        keep = np.exp(-omega_dt)
        rest = (1.0 - keep) / omega_dt
        following = np.concatenate([self.zmp[1:], self.zmp[-1:]])
        held = ((1.0 - rest) * self.zmp + (rest - keep) * following) / (1.0 - keep)
        return planned_dcm(held, omega_dt)

    @cached_property
    def supports(self) -> Supports:
        """Where the ZMP may be at each sample."""
        return Supports(self.plan, self.sole, self.times)

    def suffices(self, tick: int) -> bool:
        """Return whether enough of the plan is sampled for a planning tick."""
        return not self.rest or tick - self.first <= SPAN - RENEWAL

    def index(self, tick: int) -> int:
        """Return the sample of a planning tick."""
        return min(tick - self.first, len(self.zmp) - 1)

    def window(self, samples: Array, tick: int) -> Array:
        """Return the `AHEAD` of samples (M, d) that follow a planning tick."""
        first = tick - self.first + 1
        window = samples[first : first + AHEAD]
        if len(window) < AHEAD:
            last = np.broadcast_to(samples[-1], (AHEAD - len(window), samples.shape[1]))
            window = np.concatenate([window, last])
        return window

    def planned_dcm(self, place: float) -> Array:
        """Return the DCM (2,) in m at a time since the walk's start, in planning ticks."""
        place -= self.first
        here = min(max(int(place), 0), len(self.dcm) - 2)
        share = min(max(place - here, 0.0), 1.0)
        value: Array = (1.0 - share) * self.dcm[here] + share * self.dcm[here + 1]
        return value


def sample_plan(
    plan: FootstepPlan, start: float, tick: int, model: WalkerModel, span: int | None = SPAN
) -> SampledPlan:
    """Return a plan sampled from a planning tick on, as far as one looks ahead and a span more.

    Args:
        plan: the footsteps.
        start: time of the planning tick 0, s.
        tick: the first one to sample.
        model: of the robot.
        span: planning ticks; None: to the end of the plan.
    """
    left = max(0, int(np.ceil((plan.end - start) / PLANNING_DT)) - tick)
    span = left if span is None else min(left, span)
    times: Array = start + PLANNING_DT * np.arange(tick, tick + span + AHEAD + 2, dtype=np.float64)
    near = _within(plan, float(times[0]), float(times[-1]))
    reference = zmp_reference(near, model.sole).at(times)
    shift = swing_zmp_shift(near, times, model.momentum, model.swing_height)
    zmp = reference - shift
    dcm = planned_dcm(zmp, model.omega * PLANNING_DT)
    rest = max(0, left - span - AHEAD)
    return SampledPlan(plan, model.sole, tick, times, model.omega, reference, shift, zmp, dcm, rest)


def _within(plan: FootstepPlan, begin: float, end: float) -> FootstepPlan:
    """Return the part of a plan that says what is asked for between two times, s."""
    following = plan.next_lift(end)
    if following is not None:  # kept, for the ZMP goes to the foot that bears it
        plan = plan.replace_after(following.lift, ())
    return plan.since(begin)
