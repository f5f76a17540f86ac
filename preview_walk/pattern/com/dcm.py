"""The DCM planned backwards from the plan's ZMP, with the CoM following it (Englsberger et al.).

The DCM xi' = omega (xi - p) is integrated backwards in time from the plan's end, where it rests on
the ZMP; the CoM follows it by itself, c' = omega (xi - c). After a plan is replaced the DCM is off
the new plan's by some error, which a ZMP of

    p = p_ref + (1 + k / omega) (xi - xi_ref)

makes decay at the rate k (Englsberger, Ott and Albu-Schaeffer, T-RO 2015, the DCM tracking
law), so that nothing jumps. The ZMP runs straight from planning tick to planning tick, for which
everything in between is known in closed form.
"""

from __future__ import annotations

from math import cosh, sinh

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.pattern.com.generator import pendulum_rows
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, SampledPlan
from preview_walk.preview.cart_table import ComState
from preview_walk.preview.checks import read_only
from preview_walk.types import Array


class DcmGenerator:
    """The CoM that follows the plan's DCM.

    The rate k is omega: of all ZMPs that bring the DCM back, its strays least from the plan's in
    the mean square.
    """

    def __init__(self, height: float) -> None:
        """Follow with the natural frequency of a pendulum of this height (m)."""
        self._omega = (GRAVITY / height) ** 0.5

    def rejoin(self, com: Array, dcm: Array, zmp: Array) -> ComState:
        """Return a state with this CoM, DCM and ZMP, each (2,) in m."""
        velocity, acceleration = pendulum_rows(com, dcm, zmp, self._omega)
        rows = np.array([com, velocity, acceleration, np.zeros(2), zmp])
        return ComState(read_only(rows))

    def step(self, state: ComState, sampled: SampledPlan, tick: int) -> ComState:
        """Return the state one planning tick after `state`, which is that of `tick`."""
        here, there = sampled.index(tick), sampled.index(tick + 1)
        error = state.com + state.velocity / self._omega - sampled.dcm_of_lines[here]
        return self._moved(state, sampled.zmp[there] + 2.0 * error, PLANNING_DT)

    def interpolate(self, state: ComState, following: ComState, tau: float) -> ComState:
        """Return the state tau (s) after `state`; the ZMP runs straight in between."""
        share = tau / PLANNING_DT
        return self._moved(state, (1.0 - share) * state.zmp + share * following.zmp, tau)

    def dcm(self, following: ComState, sampled: SampledPlan, place: float) -> Array:
        """Return the DCM (2,) in m from which the plan's ZMP keeps the CoM bounded."""
        return sampled.planned_dcm(place)

    def _moved(self, state: ComState, zmp: Array, tau: float) -> ComState:
        """Return the state after tau (s) in which the ZMP runs straight to `zmp` (2,), m."""
        omega = self._omega
        if tau <= 0.0:
            return state
        slope = (zmp - state.zmp) / tau
        grow, turn = cosh(omega * tau), sinh(omega * tau)
        lead, rate = state.com - state.zmp, state.velocity - slope
        com = zmp + grow * lead + (turn / omega) * rate
        velocity = slope + omega * turn * lead + grow * rate
        jerk = omega**2 * (velocity - slope)
        return ComState(read_only(np.array([com, velocity, omega**2 * (com - zmp), jerk, zmp])))
