"""Flight: no sole feels the ground, so no step can be made until one does."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from preview_walk.footsteps.plan import FootstepPlan

UNFELT = 0.002
"""A sole that carries less than this share of the weight does not feel the ground."""

FLIGHT_TIME = 0.1
"""A robot flies that has felt no ground for so long (s): dropped, it is 49 mm down. The load of
walks and recovery steps passes from foot to foot with gaps that are shorter."""

PAUSE = 0.3
"""The next step waits at least for this time (s), again and again until the ground is felt."""


@dataclass(frozen=True)
class Flight:
    """Whether the robot flies; at first it stands.

    Attributes:
        felt: when a sole last felt the ground, s.
        flies: whether the robot is taken to fly.
    """

    felt: float = inf
    flies: bool = False


def feel(last: Flight, t: float, load: float) -> Flight:
    """Return whether the robot flies at time t (s).

    Args:
        last: what was felt before.
        t: now, s.
        load: of both soles, as a share of the weight.
    """
    if load > UNFELT or last.felt == inf:
        return Flight(t)
    return Flight(last.felt, t - last.felt > FLIGHT_TIME)


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
