"""The walking pattern: from a plan to what the robot should do at an instant.

Kajita's pattern generator, kept live: footsteps give the ZMP reference, a CoM generator (`com`) the
CoM, preview control its height. The plan may be replaced at any tick (`WalkingPattern.follow`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, PREVIEW_TIME, sample_plan
from preview_walk.pattern.com.table import DEFAULT, com_generator
from preview_walk.pattern.com_height import wanted_heights
from preview_walk.pattern.dcm import dcm_of
from preview_walk.pattern.walker_model import WalkerModel
from preview_walk.preview.cart_table import ComState
from preview_walk.preview.controller import PreviewController
from preview_walk.types import FEET, Array

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
    """CoM references of a live plan, by a CoM generator at `PLANNING_DT`.

    Attributes:
        model: what is known of the robot.
        omega: natural frequency (1/s) of the pendulum, sqrt(g / height) with the cart-table's
            height (`WalkerModel.pendulum_height`).
        com_generator: name of the CoM generator.
    """

    def __init__(
        self, plan: FootstepPlan, com: Array, model: WalkerModel, name: str = DEFAULT
    ) -> None:
        """Start at the plan's start with the CoM at rest.

        Args:
            plan: the footsteps.
            com: (3,) where the CoM is, m.
            model: of the robot.
            name: of the CoM generator, one of `COM_GENERATORS`.

        Raises:
            InvalidInput: there is no CoM generator of that name.
        """
        self.model = model
        self.omega = model.omega
        self.com_generator = name
        self._generator = com_generator(name, model.pendulum_height)
        self._tick = 0
        self._start = plan.start
        self._now = self._generator.rejoin(com[:2], com[:2], com[:2])
        # A cart-table without height is a triple integrator: preview control of the height.
        self._lift = PreviewController(1e-9, PLANNING_DT, PREVIEW_TIME, r=HEIGHT_EFFORT)
        self._now_z: ComState = self._lift.initial_state((com[2], 0.0))
        self.follow(plan)
        self._next, self._next_z = self._step()

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by."""
        return self._sampled.plan

    def follow(self, plan: FootstepPlan) -> None:
        """Go on by another plan from the present planning tick."""
        # Sampled for some seconds from this tick on; a tick only slides the window along.
        self._sampled = sample_plan(plan, self._start, self._tick, self.model)
        times = self._sampled.times
        self._heights = np.zeros((len(times), 2))
        self._heights[:, 0] = wanted_heights(plan, times, self.model.legs)

    def planned_dcm(self, t: float) -> Array:
        """Return the DCM (2,) in m that is planned for time t (s), now or later."""
        place = (t - self._start) / PLANNING_DT
        return self._generator.dcm(self._next, self._sampled, place)

    def rejoin(self, t: float, com: Array) -> None:
        """Go on from a measured CoM (2,) with the plan's DCM at time t (s), after a push.

        The error that remains against the measured state is that of the DCM alone, which is what
        the feedback can act on.

        Args:
            t: now, s.
            com: (2,) measured, m.
        """
        self._tick = max(self._tick, int((t - self._start) / PLANNING_DT + 1e-9))
        sampled = self._sampled
        sample = sampled.index(self._tick)
        self._now = self._generator.rejoin(com, sampled.dcm[sample], sampled.zmp[sample])
        self._next, self._next_z = self._step()

    def land(self, t: float, com: Array) -> None:
        """Go on from a measured CoM (3,) in m at time t (s), after a flight: also in height."""
        self._now_z = self._lift.initial_state((com[2], 0.0))
        self.rejoin(t, com[:2])

    def _step(self) -> tuple[ComState, ComState]:
        """Return the horizontal and the vertical state one planning tick after the present."""
        return (
            self._generator.step(self._now, self._sampled, self._tick),
            self._lift.step(self._now_z, self._sampled.window(self._heights, self._tick)),
        )

    def at(self, t: float) -> ComReference:
        """Return the CoM reference at time t (s); times must not go back."""
        while t >= self._start + (self._tick + 1) * PLANNING_DT - 1e-9:
            self._tick += 1
            self._now, self._now_z = self._next, self._next_z
            if not self._sampled.suffices(self._tick):
                self.follow(self.plan)
            self._next, self._next_z = self._step()
        tau = min(max(t - self._start - self._tick * PLANNING_DT, 0.0), PLANNING_DT)
        state = self._generator.interpolate(self._now, self._next, tau)
        vertical = self._lift.interpolate(self._now_z, self._next_z, tau)
        (x, y), (vx, vy), (ax, ay) = state.array[:3].tolist()
        sampled = self._sampled
        share = tau / PLANNING_DT
        here, there = sampled.index(self._tick), sampled.index(self._tick + 1)
        reference = (1.0 - share) * sampled.reference[here] + share * sampled.reference[there]
        shift = (1.0 - share) * sampled.shift[here] + share * sampled.shift[there]
        return ComReference(
            np.array((x, y, vertical.com[0])),
            np.array((vx, vy, vertical.velocity[0])),
            np.array((ax, ay, vertical.acceleration[0])),
            state.zmp + shift,
            reference,
            dcm_of(state.com, state.velocity, self.omega),
            0.5 * sum(float(self.plan.sole(foot, t)[2, 3]) for foot in FEET),
        )
