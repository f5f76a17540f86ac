"""Preview control of the ZMP: Katayama's servo on the cart-table, as Kajita et al. 2003 use it."""

from __future__ import annotations

from preview_walk.constants import GRAVITY
from preview_walk.pattern.com.generator import pendulum_rows
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, PREVIEW_TIME, SampledPlan
from preview_walk.preview.controller import ComState, PreviewController
from preview_walk.types import Array


class PreviewGenerator:
    """The CoM by preview control of the plan's ZMP.

    Attributes:
        controller: one tick of it, with its gains.
    """

    def __init__(self, height: float) -> None:
        """Design the controller for a cart-table of this height (m)."""
        self.controller = PreviewController(height, PLANNING_DT, PREVIEW_TIME)
        self._omega = (GRAVITY / height) ** 0.5

    def rejoin(self, com: Array, dcm: Array, zmp: Array) -> ComState:
        """Return a state with this CoM, DCM and ZMP, each (2,) in m."""
        return self.controller.initial_state(com, *pendulum_rows(com, dcm, zmp, self._omega))

    def step(self, state: ComState, sampled: SampledPlan, tick: int) -> ComState:
        """Return the state one planning tick after `state`, which is that of `tick`."""
        return self.controller.step(state, sampled.window(sampled.zmp, tick))

    def interpolate(self, state: ComState, following: ComState, tau: float) -> ComState:
        """Return the state tau (s) after `state`; the jerk is constant in between."""
        return self.controller.interpolate(state, following, tau)

    def dcm(self, following: ComState, sampled: SampledPlan, place: float) -> Array:
        """Return the DCM (2,) in m from which the plan's ZMP keeps the CoM bounded."""
        return sampled.planned_dcm(place)
