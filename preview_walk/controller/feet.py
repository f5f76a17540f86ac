"""The feet: which stand and which swing, by the plan and by what the soles feel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at, rpy_of, yaw_of
from preview_walk.pattern.swing import Swing
from preview_walk.types import FEET, Array, Foot

CONTACT_FORCE = 0.03
"""A sole counts as on the ground when it carries this share of the weight."""

TOUCH_FORCE = 0.002
"""A foot that is due has landed when it carries this share of the weight."""

DESCENT = 0.6
"""Share of the swing from which a touch is a landing: before it, the foot has hit something."""

GRACE = 0.02
"""A foot that is due counts as standing for this long (s) before the ground must be felt."""


@dataclass(frozen=True)
class Search:
    """How a foot that is due and does not feel the ground looks for it.

    Attributes:
        speed: at which it goes on down, m/s.
        time: so long after it was due it counts as standing all the same, s.
        near: so close (m) above its place it need not feel the ground: for sensors that do not
            tell a light touch from noise, on ground that is known.
    """

    speed: float = 0.15
    time: float = 0.15
    near: float = 0.0


SEARCH = Search()
"""The search where a foot should have landed: 2 cm down."""

DEEP_SEARCH = Search(0.8, 0.2)
"""The search on ground that is not known: 16 cm down."""

NOISY_SEARCH = Search(near=0.005)
"""The search of a robot whose force sensors are not exact."""

SINK_SPEED = 0.05
"""A foot that should stand and carries nothing goes down at this speed (m/s): while all the load is
on the edge of the other one it would come off the ground, and hit it when load returns."""

HANG = 0.05
"""A foot that is to lift within this time (s) need not sink."""

RAMP_TIME = 0.02
"""Time (s) over which a new contact comes to its full load, and a lifting one is freed of it."""

_STILL = np.zeros(6)
_STILL.setflags(write=False)


@dataclass(frozen=True, eq=False)
class FootState:
    """A foot as it is.

    Attributes:
        contact: whether it counts as standing.
        felt: whether it has felt the ground since its last lift.
        since: when it came to stand, s.
        bare: when it last stood without any load, s.
        swing: its swing, or its last one; None before the first.
    """

    contact: bool
    felt: bool
    since: float
    bare: float
    swing: Swing | None


@dataclass(frozen=True, eq=False)
class FootTarget:
    """What a foot should do at one instant, in the world.

    Attributes:
        contact: whether it stands; the motion below is then that of the plan's sole, at rest.
        pose: (4, 4) of the sole, m.
        velocity: (6,) [linear; angular], m/s, rad/s.
        acceleration: (6,) [linear; angular], m/s^2, rad/s^2.
        sink: how fast a contact that has come off the ground goes down, m/s.
    """

    contact: bool
    pose: Array
    velocity: Array
    acceleration: Array
    sink: float = 0.0


class Feet:
    """Follows a plan's lifts and landings; the ground decides when a landing is one.

    Attributes:
        states: of each foot.
        targets: what each foot should do, as of the last `follow`.
        searching: whether a foot that is due looks for the ground.
    """

    def __init__(
        self,
        plan: FootstepPlan,
        weight: float,
        swing_height: float,
        search: Search = SEARCH,
    ) -> None:
        """Stand on the plan's first soles.

        Args:
            plan: the walk.
            weight: of the robot, N.
            swing_height: of a swing's apex above the higher of its two soles, m.
            search: for the ground, by feet that are due.
        """
        self._search = search
        self._weight = weight
        self._swing_height = swing_height
        self.searching = False
        stands = FootState(True, True, -np.inf, -np.inf, None)
        self.states: dict[Foot, FootState] = dict.fromkeys(FEET, stands)
        self.targets = {
            foot: FootTarget(True, plan.sole(foot, plan.start), _STILL, _STILL) for foot in FEET
        }

    @property
    def standing(self) -> tuple[Foot, ...]:
        """The feet in contact, left first."""
        return tuple(foot for foot in FEET if self.states[foot].contact)

    def follow(
        self,
        t: float,
        plan: FootstepPlan,
        soles: Mapping[Foot, Array],
        normal_force: Mapping[Foot, float],
    ) -> Foot | None:
        """Set `states` and `targets` at time t (s); return the foot that landed early, if any.

        Args:
            t: now, s.
            plan: the walk.
            soles: measured poses (4, 4), world, m.
            normal_force: what each sole's sensor reads, N.
        """
        step = plan.swing_at(t)
        early, self.searching = None, False
        for foot in FEET:
            load = normal_force[foot] / self._weight
            if step is not None and step.foot == foot:
                stood = plan.start_pose(step)
                if self._swing(t, step, soles[foot], stood, load > CONTACT_FORCE):
                    early = foot
                continue
            there = soles[foot][2, 3] - plan.sole(foot, t)[2, 3] < self._search.near
            target = self._stand(t, plan, foot, load > TOUCH_FORCE or bool(there))
            if target.contact and load < TOUCH_FORCE:
                if sum(normal_force.values()) > 0.5 * self._weight:
                    self.states[foot] = replace(self.states[foot], bare=t)
                if not _lifts(plan, t, foot):
                    target = replace(target, sink=SINK_SPEED)
            self.targets[foot] = target
            self.searching |= not target.contact
        return early

    def fly(self, targets: Mapping[Foot, FootTarget]) -> None:
        """Take both feet off the ground, to do what a flight asks for."""
        for foot in FEET:
            self.states[foot] = replace(self.states[foot], contact=False, felt=False)
            self.targets[foot] = targets[foot]

    def land(self, t: float) -> None:
        """Stand on both feet from time t (s) on: one that does not feel the ground sinks."""
        self.searching = False
        for foot in FEET:
            self.states[foot] = FootState(True, True, t, t, None)

    def _swing(self, t: float, step: Footstep, sole: Array, stood: Array, touching: bool) -> bool:
        """Move a foot along its swing; return whether it has just touched down.

        `sole`: where it is measured; `stood`: where it lifts in the plan, poses (4, 4).
        """
        state = self.states[step.foot]
        swing, contact, felt, since = state.swing, state.contact, state.felt, state.since
        if swing is None or swing.lift != step.lift:
            # From where the foot is, so that no error of this stance goes into the next, but with
            # the plan's tilt: a sole that rocks when it lifts is to come down flat.
            x, y, z = sole[:3, 3].tolist()
            roll, pitch, _ = rpy_of(stood)
            start = pose_at(x, y, yaw_of(sole), z, pitch, roll)
            swing = Swing(
                start, step.pose, step.lift, step.land, self._swing_height, shape=step.swing
            )
            contact = felt = False
        elif swing.end is not step.pose or swing.land != step.land:
            swing = swing.retarget(t, step.pose, step.land, step.swing)
        descending = t > step.lift + DESCENT * (step.land - step.lift)
        landed = not contact and descending and touching
        if landed:
            contact, felt, since = True, True, t
        self.states[step.foot] = FootState(contact, felt, since, state.bare, swing)
        self.targets[step.foot] = FootTarget(contact, *swing.at(t))
        return landed

    def _stand(self, t: float, plan: FootstepPlan, foot: Foot, touching: bool) -> FootTarget:
        """Keep a foot on the ground, or send it further down until it is there."""
        state, pose = self.states[foot], plan.sole(foot, t)
        felt = state.felt or touching
        late = np.inf if state.swing is None else t - state.swing.land
        if felt or not GRACE < late < self._search.time:
            since = state.since if state.contact else t
            self.states[foot] = FootState(True, felt, since, state.bare, state.swing)
            return FootTarget(True, pose, _STILL, _STILL)
        self.states[foot] = FootState(False, felt, state.since, state.bare, state.swing)
        lower = pose.copy()
        lower[2, 3] -= self._search.speed * late
        down = np.array((0.0, 0.0, -self._search.speed, 0.0, 0.0, 0.0))
        return FootTarget(False, lower, down, _STILL)

    def normal_limits(self, t: float, plan: FootstepPlan) -> dict[Foot, float]:
        """Return the normal force (N) that each foot in contact may carry at time t (s)."""
        lifting = plan.next_lift(t)
        limits: dict[Foot, float] = {}
        for foot in self.standing:
            state = self.states[foot]
            # What does not feel the ground cannot be leant on, whatever the plan says.
            share = min(1.0, (t - max(state.since, state.bare)) / RAMP_TIME + 0.02)
            if lifting is not None and lifting.foot == foot:
                share = min(share, (lifting.lift - t) / RAMP_TIME + 0.01)
            limits[foot] = 2.0 * self._weight * share
        return limits


def _lifts(plan: FootstepPlan, t: float, foot: Foot) -> bool:
    """Return whether a foot lifts within `HANG` from t (s)."""
    step = plan.next_lift(t)
    return step is not None and step.foot == foot and step.lift - t < HANG
