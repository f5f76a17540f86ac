"""Wieber's ZMP MPC: the least jerk that keeps the ZMP within the support polygons of the plan.

Every `PERIOD` planning ticks the jerks of the whole horizon are found, each constant over so many
ticks, of which the first one is used (Wieber, Humanoids 2006; `preview.zmp_mpc` is the same walk
offline). No reference is followed: the ZMP is where the least jerk has it on the soles. What the
swinging legs add to the cart-table's ZMP counts too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.com.generator import pendulum_rows
from preview_walk.pattern.com.sampled_plan import AHEAD, PLANNING_DT, SampledPlan
from preview_walk.preview.cart_table import ComState, coasted, sampled_cart_table
from preview_walk.preview.checks import read_only
from preview_walk.preview.least_distance import least_distance
from preview_walk.preview.least_input import outputs_ahead
from preview_walk.types import Array

PERIOD = 4
"""Planning ticks from one problem to the next, and that a jerk lasts: 20 ms."""

SAMPLES = AHEAD // PERIOD
"""Jerks of a horizon, and samples at which the ZMP is within the support."""


@dataclass(frozen=True, eq=False, repr=False)
class MpcState(ComState):
    """The CoM of a cart-table at one instant, and the motion foreseen when last a problem was.

    Attributes:
        path: the states foreseen, from that of `solved` on, one for each `PERIOD`; empty where no
            problem has been solved yet.
        solved: planning tick at which it was.
        plan: for which plan.
    """

    path: tuple[ComState, ...] = ()
    solved: int = 0
    plan: FootstepPlan | None = None

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle so that the array is read-only again afterwards."""
        return _locked, (self.array, self.path, self.solved, self.plan)


class MpcGenerator:
    """The CoM by predictive control within the support polygons."""

    def __init__(self, height: float) -> None:
        """Predict with a cart-table of this height (m)."""
        self._omega = (GRAVITY / height) ** 0.5
        plant = sampled_cart_table(height, PERIOD * PLANNING_DT)
        self._lever = -float(plant.C[0, 2])
        ahead = outputs_ahead(plant.A, plant.B, plant.C, plant.D, SAMPLES)
        self._free, self._forced = ahead.free[:, 0], ahead.forced[:, 0, :, 0]

    def rejoin(self, com: Array, dcm: Array, zmp: Array) -> MpcState:
        """Return a state with this CoM, DCM and ZMP, each (2,) in m."""
        velocity, acceleration = pendulum_rows(com, dcm, zmp, self._omega)
        return MpcState(read_only(np.array([com, velocity, acceleration, np.zeros(2), zmp])))

    def step(self, state: ComState, sampled: SampledPlan, tick: int) -> MpcState:
        """Return the state one planning tick after `state`, which is that of `tick`."""
        assert isinstance(state, MpcState)
        path, solved = state.path, state.solved
        if not path or tick >= solved + PERIOD or state.plan is not sampled.plan:
            path, solved = self._foreseen(state, sampled, tick), tick
        after = coasted(state, path[1].jerk, PLANNING_DT, self._lever)
        return MpcState(after.array, path, solved, sampled.plan)

    def interpolate(self, state: ComState, following: ComState, tau: float) -> ComState:
        """Return the state tau (s) after `state`; the jerk is constant in between."""
        return coasted(state, following.jerk, tau, self._lever)

    def dcm(self, following: ComState, sampled: SampledPlan, place: float) -> Array:
        """Return the DCM (2,) in m that was foreseen; past the horizon, that of the plan's ZMP."""
        assert isinstance(following, MpcState)
        since = max(0.0, (place - following.solved) / PERIOD)
        if since >= SAMPLES:
            return sampled.planned_dcm(place)
        here = following.path[int(since)]
        tau = (since - int(since)) * PERIOD * PLANNING_DT
        then = coasted(here, following.path[int(since) + 1].jerk, tau, self._lever)
        return np.asarray(then.com + then.velocity / self._omega)

    def _foreseen(self, state: ComState, sampled: SampledPlan, tick: int) -> tuple[ComState, ...]:
        """Return the states of the horizon that begins at `tick`."""
        rows, bounds = self._conditions(state, sampled, tick)
        found = least_distance(rows, bounds)
        # Each jerk moves the ZMP at its end as far as it likes: only rounding can leave none, and
        # for one period the CoM can do without.
        jerks = np.zeros((SAMPLES, 2)) if found is None else found.reshape(2, -1).T
        path = [ComState(state.array)]
        for jerk in jerks:
            path.append(coasted(path[-1], jerk, PERIOD * PLANNING_DT, self._lever))
        return tuple(path)

    def _conditions(self, state: ComState, sampled: SampledPlan, tick: int) -> tuple[Array, Array]:
        """Return rows (R, 2 SAMPLES) and bounds (R,) of jerks that keep the ZMP on the soles."""
        samples = sampled.index(tick) + PERIOD * np.arange(1, SAMPLES + 1)
        planes = sampled.supports.around(samples, PERIOD)
        count = [len(offsets) for _, offsets in planes]
        normals = np.concatenate([sides for sides, _ in planes])
        offsets = np.concatenate([offsets for _, offsets in planes])
        shift = sampled.shift[np.minimum(samples, len(sampled.shift) - 1)]
        coasting = np.repeat(self._free @ state.array[:3] + shift, count, axis=0)
        forced = np.repeat(self._forced, count, axis=0)
        rows = np.hstack([normals[:, :1] * forced, normals[:, 1:] * forced])
        return rows, offsets - (normals * coasting).sum(axis=1)


def _locked(
    array: Array, path: tuple[ComState, ...], solved: int, plan: FootstepPlan | None
) -> MpcState:
    """Return a pickled state, made read-only."""
    return MpcState(read_only(array), path, solved, plan)
