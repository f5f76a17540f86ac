"""What a CoM generator is: a state, a step from one planning tick to the next, a way between."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from preview_walk.pattern.com.sampled_plan import SampledPlan
from preview_walk.preview.cart_table import ComState
from preview_walk.types import Array


class ComGenerator(Protocol):
    """Leads the CoM along a plan, planning tick by planning tick.

    A generator remembers nothing: a state holds all there is to know of the past, the sampled plan
    all of the future. Either may be replaced at any tick.
    """

    def rejoin(self, com: Array, dcm: Array, zmp: Array) -> ComState:
        """Return a state to go on from, at the start (all three alike) or after a push.

        Args:
            com: (2,) where the CoM is, m.
            dcm: (2,) the DCM it is to have, m.
            zmp: (2,) the cart-table's ZMP it is to have, m.
        """

    def step(self, state: ComState, sampled: SampledPlan, tick: int) -> ComState:
        """Return the state one planning tick after `state`, which is that of `tick`."""

    def interpolate(self, state: ComState, following: ComState, tau: float) -> ComState:
        """Return the exact state tau (s) after `state`, on the way to `following`."""

    def dcm(self, following: ComState, sampled: SampledPlan, place: float) -> Array:
        """Return the DCM (2,) in m that is planned for a place in time, now or later.

        Args:
            following: the state of the planning tick that comes next.
            sampled: the plan.
            place: time since the walk's start in planning ticks, with its fraction.
        """


def pendulum_rows(com: Array, dcm: Array, zmp: Array, omega: float) -> tuple[Array, Array]:
    """Return velocity (m/s) and acceleration (m/s^2) of a pendulum, each (2,).

    Args:
        com: (2,) position, m.
        dcm: (2,) m.
        zmp: (2,) of the cart-table, m.
        omega: natural frequency of the pendulum, 1/s.
    """
    return np.asarray(omega * (dcm - com)), np.asarray(omega**2 * (com - zmp))
