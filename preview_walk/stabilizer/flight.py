"""Flight: no sole feels the ground, so the walk stands still until one does, and then goes on.

Gravity alone moves the CoM then, at a steady velocity over the ground. Soles held below the DCM are
below it wherever the robot comes down, and there a robot can come to rest on both feet.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import NamedTuple

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import Heading, compose, midfeet, pose_at, relative, rpy_of
from preview_walk.types import FEET, Array, Foot

UNFELT = 0.002
"""A sole that carries less than this share of the weight does not feel the ground."""

FLIGHT_TIME = 0.1
"""A robot flies that has felt no ground for so long (s): dropped, it is 49 mm down. The load of
walks and recovery steps passes from foot to foot with gaps that are shorter."""

PAUSE = 0.3
"""The next step waits at least for this time (s), again and again until the ground is felt."""

CLEAR = 0.01
"""Soles that are higher above the plan's ground than this (m) have left it; lower ones may stand
there, with sensors that are dead."""

CATCH = 3.0
"""Weight shifts of a plan between a landing and the next step: one to catch the fall, two to
stand."""


class Flight(NamedTuple):
    """Whether the robot flies; at first it stands.

    Attributes:
        felt: when a sole last felt the ground, s.
        flies: whether the ground has not been felt for a while: no step can be made.
        airborne: whether the soles have left the ground.
    """

    felt: float = inf
    flies: bool = False
    airborne: bool = False


def feel(last: Flight, t: float, load: float, clearance: float, lifted: bool) -> Flight:
    """Return whether the robot flies at time t (s).

    Args:
        last: what was felt before.
        t: now, s.
        load: of both soles, as a share of the weight.
        clearance: of the lower sole above the plan's ground, m.
        lifted: whether something bears the robot.
    """
    if lifted:
        return Flight(last.felt, True, True)
    if load > UNFELT or last.felt == inf:
        return Flight(t)
    flies = last.flies or t - last.felt > FLIGHT_TIME
    return Flight(last.felt, flies, last.airborne or (flies and clearance > CLEAR))


def waiting(plan: FootstepPlan, t: float) -> FootstepPlan | None:
    """Return the plan of a robot in flight whose next step waits, or None while none is near.

    A foot that swings already goes to where it was to land.

    Args:
        plan: the walk.
        t: now, s.
    """
    step = plan.next_lift(t)
    if step is None or step.lift > t + 0.5 * PAUSE:
        return None
    delay = t + PAUSE - step.lift
    later = plan.steps[plan.steps.index(step) :]
    return plan.replace_after(
        t, [replace(s, lift=s.lift + delay, land=s.land + delay) for s in later]
    )


def stand_on(plan: FootstepPlan, t: float, soles: dict[Foot, Array]) -> FootstepPlan:
    """Return the plan of a robot that stands on these soles from now on, and then walks on.

    The steps that have not landed are made after a pause, where they are from the soles' middle as
    they were from the plan's. A step in the air has been made: both feet are down now.

    Args:
        plan: the walk up to now.
        t: now, s.
        soles: pose (4, 4) of each sole, world, m.
    """
    stand = FootstepPlan.standing(soles["left"], soles["right"], t, plan.weight_shift)
    step, later = plan.next_lift(t), plan.steps[len(plan.lifted(t)) :]
    if step is None:
        return stand
    swing = plan.swing_at(t)
    planned = midfeet(*(plan.sole(foot, t if swing is None else swing.land) for foot in FEET))
    now = midfeet(soles["left"], soles["right"])
    delay = max(0.0, t + CATCH * plan.weight_shift - step.lift)
    return stand.replace_after(
        t,
        [
            replace(
                s, pose=_carried(s.pose, planned, now), lift=s.lift + delay, land=s.land + delay
            )
            for s in later
        ],
    )


def _carried(pose: Array, before: Heading, after: Heading) -> Array:
    """Return a sole's pose moved as one heading (x, y, yaw) moves to another, at its height."""
    roll, pitch, yaw = rpy_of(pose)
    x, y, turn = relative(before, (float(pose[0, 3]), float(pose[1, 3]), yaw))
    return pose_at(*compose(after, x, y, turn), float(pose[2, 3]), pitch, roll)
