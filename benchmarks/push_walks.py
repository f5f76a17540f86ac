"""Walks with one push, at one moment of a step, in one direction."""

from __future__ import annotations

from copy import deepcopy
from functools import lru_cache
from math import cos, radians, sin

from push_bound_table import GAITS

import preview_walk as pw
from preview_walk import Foot, other

PUSH_TIME, AFTER = 0.2, 6.0
"""Seconds that a push lasts, and that a walk is watched after it."""


def pushed(
    robot: str, stance: str, share: float | None, angle: int, impulse: float, *, body: str = ""
) -> pw.Record:
    """Return the record of a walk with a push of this impulse (N·s) on a body, else the base."""
    walk, begin = unpushed(robot, stance, share)
    force, mirror = impulse / PUSH_TIME, 1.0 if stance == "left" else -1.0
    along = (force * cos(radians(angle)), mirror * force * sin(radians(angle)), 0.0)
    walk = deepcopy(walk)
    walk.plant.add_push(pw.Push(begin, PUSH_TIME, along, body or None))
    return walk.run(until=begin + PUSH_TIME + AFTER).record()


@lru_cache(maxsize=1)
def unpushed(robot: str, stance: str, share: float | None) -> tuple[pw.Walk, float]:
    """Return a walk a moment before its push, whose time (s) it returns too; one to copy."""
    whole = pw.loaded_robot(robot)
    gait = GAITS[robot.upper()]
    step_time = gait.single_support + gait.double_support
    planner = pw.FootstepPlanner(
        gait.step_length, whole.step_width, step_time, gait.double_support / step_time
    )
    foot: Foot = "left" if stance == "left" else "right"
    plan = planner.generate_footsteps(14 if share is not None else 0)
    begin = 1.0
    if share is not None:
        step = [s for s in plan.steps if s.foot == other(foot)][1]
        begin = step.lift + share * (step.land - step.lift)
    return pw.Walk(whole, plan).run(until=begin - 0.05), begin
