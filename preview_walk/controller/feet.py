"""The feet: which stand and which swing, by the plan and by what the soles feel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.pattern.swing import Swing
from preview_walk.tracking.dynamics import FrameTerms
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot

CONTACT_FORCE = 0.03
"""A sole counts as on the ground when it carries this share of the weight."""

TOUCH_FORCE = 0.002
"""A foot that is due has landed when it carries this share of the weight."""

DESCENT = 0.6
"""Share of the swing from which a touch is a landing: before it, the foot has hit something."""

GRACE = 0.02
"""A foot that is due counts as standing for this long (s) before the ground must be felt ..."""

PROBE_SPEED = 0.15
"""... else it goes on down at this speed (m/s) ..."""

PROBE_TIME = 0.15
"""... until this long (s) after it was due; then it counts as standing."""

SINK_SPEED = 0.05
"""A foot that should stand and carries nothing goes down at this speed (m/s): while all the load is
on the edge of the other one it would come off the ground, and hit it when load returns ..."""

HANG = 0.05
"""... unless it is to lift within this time (s)."""

RAMP_TIME = 0.02
"""Time (s) over which a new contact comes to its full load, and a lifting one is freed of it."""


@dataclass
class FootState:
    """A foot: in contact `since` (s), or on `swing`; `pose` (4, 4) is where it should be.

    `felt`: whether it has felt the ground since its last lift; `bare`: when (s) it last stood
    without any load.
    """

    contact: bool
    felt: bool
    since: float
    bare: float
    swing: Swing | None
    pose: Array


class Feet:
    """Follows a plan's lifts and landings; the ground decides when a landing is one."""

    def __init__(
        self, body: WholeBodyController, plan: FootstepPlan, weight: float, swing_height: float
    ) -> None:
        """Stand on the plan's first soles; `weight` in N, `swing_height` of the apex in m."""
        self._body = body
        self._weight = weight
        self._swing_height = swing_height
        self.states = {
            foot: FootState(True, True, -np.inf, -np.inf, None, plan.sole(foot, plan.start))
            for foot in FEET
        }

    def __getitem__(self, foot: Foot) -> FootState:
        """Return the state of a foot."""
        return self.states[foot]

    def follow(
        self, t: float, plan: FootstepPlan, normal_force: Mapping[Foot, float]
    ) -> Foot | None:
        """Set the foot tasks at t (s); return the foot that touched down before its time, if any.

        `normal_force` (N): what the sole's sensor reads.
        """
        step = plan.swing_at(t)
        early = None
        self._body.sink.clear()
        for foot, state in self.states.items():
            load = normal_force[foot] / self._weight
            if step is not None and step.foot == foot:
                if self._swing(t, step, state, load > CONTACT_FORCE):
                    early = foot
            else:
                self._stand(t, plan, foot, state, load > TOUCH_FORCE)
                if state.contact and load < TOUCH_FORCE:
                    if sum(normal_force.values()) > 0.5 * self._weight:
                        state.bare = t
                    if not _lifts(plan, t, foot):
                        self._body.sink[foot] = SINK_SPEED
        return early

    def _swing(self, t: float, step: Footstep, state: FootState, touching: bool) -> bool:
        """Move a foot along its swing; return whether it has just touched down."""
        foot, swing = step.foot, state.swing
        if swing is None or swing.lift != step.lift:
            # From where the foot is, so that no error of this stance goes into the next.
            terms = self._body.dynamics.soles[foot]
            x, y, z = terms.position.tolist()
            start = pose_at(x, y, yaw_of(sole_pose(terms)), z)
            swing = Swing(start, step.pose, step.lift, step.land, self._swing_height)
            state.contact = state.felt = False
        elif swing.end is not step.pose or swing.land != step.land:
            swing = swing.retarget(t, step.pose, step.land)
        descending = t > step.lift + DESCENT * (step.land - step.lift)
        landed = not state.contact and descending and touching
        if landed:
            state.contact, state.felt, state.since = True, True, t
        task = self._body.foot_tasks[foot]
        state.swing = swing
        state.pose, task.velocity, task.acceleration = swing.at(t)
        task.pose = state.pose
        return landed

    def _stand(
        self, t: float, plan: FootstepPlan, foot: Foot, state: FootState, touching: bool
    ) -> None:
        """Keep a foot on the ground, or send it further down until it is there."""
        state.pose = plan.sole(foot, t)
        state.felt |= touching
        late = np.inf if state.swing is None else t - state.swing.land
        if state.felt or not GRACE < late < PROBE_TIME:
            if not state.contact:
                state.contact, state.since = True, t
            return
        state.contact = False
        task = self._body.foot_tasks[foot]
        task.pose = state.pose.copy()
        task.pose[2, 3] -= PROBE_SPEED * late
        task.velocity = np.array((0.0, 0.0, -PROBE_SPEED, 0.0, 0.0, 0.0))
        task.acceleration = np.zeros(6)

    def normal_limits(self, t: float, plan: FootstepPlan) -> dict[Foot, float]:
        """Return the normal force (N) that each foot in contact may carry at t (s)."""
        lifting = plan.next_lift(t)
        limits: dict[Foot, float] = {}
        for foot, state in self.states.items():
            if not state.contact:
                continue
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


def sole_pose(terms: FrameTerms) -> Array:
    """Return the measured pose (4, 4) of a sole in the world."""
    pose = np.zeros((4, 4))
    pose[:3, :3], pose[:3, 3], pose[3, 3] = terms.rotation, terms.position, 1.0
    return pose
