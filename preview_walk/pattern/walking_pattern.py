"""The walking pattern: from a plan to what the robot should do at an instant.

Kajita's pattern generator, kept live: footsteps give the ZMP reference, preview control the CoM,
polynomials the swing foot. The plan may be replaced at any tick (`WalkingPattern.follow`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import Sole
from preview_walk.pattern.com_height import LegGeometry, wanted_heights
from preview_walk.pattern.dcm import dcm_of, planned_dcm
from preview_walk.pattern.swing_moment import MomentumModel, swing_zmp_shift
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.preview.controller import ComState, PreviewController
from preview_walk.types import FEET, Array

PLANNING_DT = 0.005
"""Time (s) between two steps of the preview controller: Kajita's T."""

PREVIEW_TIME = 1.6
"""Preview horizon (s): Kajita's 320 samples of 5 ms."""

HEIGHT_EFFORT = 3e-3
"""Weight of the vertical jerk's increments: the height follows its steps within about 0.3 s."""


@dataclass(frozen=True, eq=False)
class ComReference:
    """What the CoM should do at one instant, in the world.

    Attributes:
        com: (3,) position, m.
        velocity: (3,), m/s.
        acceleration: (3,), m/s^2.
        zmp: (2,) the ZMP of that motion, m.
        zmp_ref: (2,) the ZMP that the plan asks for, m.
        dcm: (2,) com + velocity / omega, m.
        ground: height that the ZMP lies on, m.
    """

    com: Array
    velocity: Array
    acceleration: Array
    zmp: Array
    zmp_ref: Array
    dcm: Array
    ground: float


class WalkingPattern:
    """CoM references of a live plan, by preview control at `PLANNING_DT`.

    Attributes:
        legs: how high the CoM can be.
        omega: natural frequency (1/s) of the pendulum, sqrt(g / height) with the cart-table's
            height (`MomentumModel.effective_height`).
    """

    def __init__(
        self,
        plan: FootstepPlan,
        com: Array,
        legs: LegGeometry,
        sole: Sole,
        momentum: MomentumModel,
        swing_height: float,
    ) -> None:
        """Start at the plan's start with the CoM at rest.

        Args:
            plan: the footsteps.
            com: (3,) where the CoM is, m.
            legs: how high it can be.
            sole: half sizes of the soles.
            momentum: angular momentum of the swinging legs.
            swing_height: of the apex of a swing, m.
        """
        self.legs = legs
        height = momentum.effective_height(legs.com_height)
        self.omega = (GRAVITY / height) ** 0.5
        self.controller = PreviewController(height, PLANNING_DT, PREVIEW_TIME)
        self._sole = sole
        self._momentum = momentum
        self._swing_height = swing_height
        self._tick = 0
        self._start = plan.start
        self._now: ComState = self.controller.initial_state(com[:2])
        # A cart-table without height is a triple integrator: preview control of the height.
        self._lift = PreviewController(1e-9, PLANNING_DT, PREVIEW_TIME, r=HEIGHT_EFFORT)
        self._now_z: ComState = self._lift.initial_state((com[2], 0.0))
        self.follow(plan)
        self._next, self._next_z = self._step()

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by."""
        return self._plan

    def follow(self, plan: FootstepPlan) -> None:
        """Go on by another plan from the present planning tick; samples all that is left of it."""
        self._plan = plan
        self._zmp = zmp_reference(plan, self._sole)
        # Sampled once per plan from this tick on; a tick only slides the window along.
        self._first = self._tick
        n = self.controller.n_preview
        rest = max(0, int(np.ceil((plan.end - self._start) / PLANNING_DT)) - self._tick)
        times: Array = self._start + PLANNING_DT * np.arange(
            self._tick, self._tick + rest + n + 2, dtype=np.float64
        )
        self._reference = self._zmp.at(times)
        self._shift = swing_zmp_shift(plan, times, self._momentum, self._swing_height)
        self._samples = self._reference - self._shift
        self._dcm = planned_dcm(self._samples, self.omega * PLANNING_DT)
        self._heights = np.zeros((len(times), 2))
        self._heights[:, 0] = wanted_heights(plan, times, self.legs)

    def planned_dcm(self, t: float) -> Array:
        """Return the DCM (2,) in m that the plan has at time t (s), now or later.

        The only one from which its ZMP reference keeps the CoM bounded.
        """
        place = (t - self._start) / PLANNING_DT - self._first
        here = min(max(int(place), 0), len(self._dcm) - 2)
        share = min(max(place - here, 0.0), 1.0)
        value: Array = (1.0 - share) * self._dcm[here] + share * self._dcm[here + 1]
        return value

    def rejoin(self, t: float, com: Array) -> None:
        """Go on from a measured CoM (2,) with the plan's DCM at time t (s), after a push.

        The error that remains against the measured state is that of the DCM alone, which is what
        the feedback can act on.

        Args:
            t: now, s.
            com: (2,) measured, m.
        """
        self._tick = max(self._tick, int((t - self._start) / PLANNING_DT + 1e-9))
        sample = min(self._tick - self._first, len(self._samples) - 1)
        velocity = self.omega * (self._dcm[sample] - com)
        acceleration = self.omega**2 * (com - self._samples[sample])
        self._now = self.controller.initial_state(com, velocity, acceleration)
        self._next, self._next_z = self._step()

    def _step(self) -> tuple[ComState, ComState]:
        """Return the horizontal and the vertical state one planning tick after the present."""
        return (
            self.controller.step(self._now, self._window(self._samples)),
            self._lift.step(self._now_z, self._window(self._heights)),
        )

    def _window(self, samples: Array) -> Array:
        """Return the preview window (n, 2) of samples; past their end the last one holds."""
        first = self._tick - self._first + 1
        n = self.controller.n_preview
        window = samples[first : first + n]
        if len(window) < n:
            last = np.broadcast_to(samples[-1], (n - len(window), 2))
            window = np.concatenate([window, last])
        return window

    def at(self, t: float) -> ComReference:
        """Return the CoM reference at time t (s); times must not go back."""
        while t >= self._start + (self._tick + 1) * PLANNING_DT - 1e-9:
            self._tick += 1
            self._now, self._now_z = self._next, self._next_z
            self._next, self._next_z = self._step()
        tau = min(max(t - self._start - self._tick * PLANNING_DT, 0.0), PLANNING_DT)
        state = self.controller.interpolate(self._now, self._next, tau)
        vertical = self._lift.interpolate(self._now_z, self._next_z, tau)
        (x, y), (vx, vy), (ax, ay) = state.array[:3].tolist()
        sample = self._tick - self._first
        share = tau / PLANNING_DT
        here = min(sample, len(self._samples) - 1)
        there = min(sample + 1, len(self._samples) - 1)
        reference = (1.0 - share) * self._reference[here] + share * self._reference[there]
        shift = (1.0 - share) * self._shift[here] + share * self._shift[there]
        return ComReference(
            np.array((x, y, vertical.com[0])),
            np.array((vx, vy, vertical.velocity[0])),
            np.array((ax, ay, vertical.acceleration[0])),
            state.zmp + shift,
            reference,
            dcm_of(state.com, state.velocity, self.omega),
            0.5 * sum(float(self._plan.sole(foot, t)[2, 3]) for foot in FEET),
        )
