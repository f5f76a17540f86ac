"""Whether motors and joint speeds are enough for a plan: what each swing asks, against what is had.

A swing is looked at as the walking pattern plans it, with the trunk upright: inverse kinematics,
then inverse dynamics. What counts is the mean over half a swing, in which a leg speeds up or slows
down: a torque over that time is the change of momentum that the swing needs, a speed over it the
angle that the joint must turn by. Peaks shorter than that are made up for by the feedback.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from preview_walk.controller.body_model import SWING_HEIGHT, walker_model
from preview_walk.controller.joint_path import JointPath
from preview_walk.controller.swing_loads import SwingLoads, swing_loads
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.step_problem import StepProblem
from preview_walk.footsteps.swing_shape import PLAIN
from preview_walk.geometry.planar import wrap
from preview_walk.geometry.poses import heading_of, relative
from preview_walk.pattern.com_path import com_path
from preview_walk.pattern.swing import swing_of
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array, Foot, other

MADE_UP = 1.5
"""A joint may be asked for this many times its torque or speed over half a swing. At 1 a motor
that gives all it has from the first to the last moment would do; a foot that comes late, a trunk
that leans and the double support make up for the rest. Of the catalogue's gaits
(`benchmarks/gaits.py`) those that fall begin here."""

TIPPED = 0.16
"""The ZMP that the motion asks for may be beyond the sole by this share of the leg over half a
swing: the trunk gives the moment by tipping, as it may in the QP of a tick."""

INSTANTS = 12
"""A swing is looked at so many times."""

_LEVEL = 0.01
"""Soles whose heights differ by more (m) stand on stairs or slopes, of which nothing is said."""

_ROUNDED = 4
"""Steps that are alike to so many digits (m, rad, s) are looked at once."""


@dataclass(frozen=True)
class Need:
    """What a swing asks for most, against what there is.

    Attributes:
        share: what is asked for over what is still made up for; above 1 the swing falls.
        text: the same in words, a sentence without its subject.
    """

    share: float
    text: str


@dataclass(frozen=True, eq=False)
class MotorLimits:
    """A robot's motors and joint speeds, as a check of plans sees them.

    Attributes:
        robot: whose.
    """

    robot: Robot

    def problems(self, plan: FootstepPlan) -> Iterator[tuple[int, StepProblem]]:
        """Yield number and problem of each step that asks for more than there is; see `Motors`."""
        for number, need in self.needs(plan):
            if need.share > 1.0:
                yield number, StepProblem(need.text, "step_length")

    def needs(self, plan: FootstepPlan) -> Iterator[tuple[int, Need]]:
        """Yield number and need of the steps over level ground with a swing of the usual shape.

        Args:
            plan: the walk.
        """
        if not plan.steps:
            return
        robot = self.robot
        times, com = com_path(plan, walker_model(robot, SWING_HEIGHT * robot.leg_length))
        seen: dict[tuple[float, ...], Need] = {}
        for number, step in enumerate(plan.steps, 1):
            if not _usual(plan, step):
                continue
            key = _key(plan, number - 1)
            if key not in seen:
                seen[key] = _largest(robot, step, _loads(robot, plan, step, (times, com)))
            yield number, seen[key]


def _usual(plan: FootstepPlan, step: Footstep) -> bool:
    """Return whether a step goes from level to level as its plan has it without obstacles."""
    soles = (plan.sole("left", step.lift), plan.sole("right", step.lift), step.pose)
    heights = [float(sole[2, 3]) for sole in soles]
    flat = all(sole[2, 2] > 1.0 - 1e-6 for sole in soles)
    return flat and max(heights) - min(heights) <= _LEVEL and step.swing == PLAIN


def _key(plan: FootstepPlan, index: int) -> tuple[float, ...]:
    """Return what a swing depends on: its step and two on each side, seen from its stance."""
    step = plan.steps[index]
    frame = heading_of(plan.sole(other(step.foot), step.lift))
    key: list[float] = [step.foot == "left"]
    for k in range(max(0, index - 2), min(len(plan.steps), index + 3)):
        near = plan.steps[k]
        for pose in (plan.start_pose(near), near.pose):
            key += relative(frame, heading_of(pose))
        key += [near.lift - step.lift, near.land - step.lift]
    return tuple(round(number, _ROUNDED) for number in key)


def _loads(
    robot: Robot, plan: FootstepPlan, step: Footstep, com: tuple[Array, Array]
) -> SwingLoads:
    """Return what one swing asks for; `com`: times (M,), s, and the CoM (M, 3), m."""
    stance = other(step.foot)
    dt = (step.land - step.lift) / INSTANTS
    times = step.lift + dt * (np.arange(INSTANTS + 2) - 0.5)
    swing = swing_of(plan, step, SWING_HEIGHT * robot.leg_length)
    standing = plan.sole(stance, step.lift)
    soles: dict[Foot, list[Array]] = {
        step.foot: [swing.at(float(t))[0] for t in times],
        stance: [standing] * len(times),
    }
    way = np.column_stack([np.interp(times, com[0], axis) for axis in com[1].T])
    a, b = heading_of(standing)[2], heading_of(plan.start_pose(step))[2]
    path = JointPath(robot).configurations(soles, way, a + 0.5 * wrap(b - a))
    return swing_loads(robot, stance, path, dt)


def _largest(robot: Robot, step: Footstep, loads: SwingLoads) -> Need:
    """Return the largest need of a step's swing: of a joint's torque or speed, or of the ground."""
    stance = other(step.foot)
    torque, speed = _over_half(loads.torque), _over_half(loads.speed)
    needs = []
    for foot in FEET:
        leg = robot.legs[foot]
        knee = leg.joints.index(leg.knee)
        for place, joint in enumerate(leg.joints):
            i = robot.pin.joints[joint].idx_v - 6
            name, has, most = robot.joint_names[i], robot.effort[i], robot.v_limit[i]
            # The standing ankle's torque is where the centre of pressure is: that is free.
            if has > 0.0 and (foot != stance or place <= knee):
                text = (
                    f"needs {torque[i]:.0f} N·m of '{name}' over half its swing, it has {has:.0f}"
                )
                needs.append(Need(torque[i] / (MADE_UP * has), f"{text} N·m"))
            text = f"needs {speed[i]:.1f} rad/s of '{name}' over half its swing, it has {most:.1f}"
            needs.append(Need(speed[i] / (MADE_UP * most), f"{text} rad/s"))
    beyond, most = float(np.hypot(*_over_half(loads.beyond))), TIPPED * robot.leg_length
    text = f"needs the ZMP {beyond:.2f} m outside the {stance} sole over half its swing"
    needs.append(Need(beyond / most, f"{text}, at most {most:.2f} m is made up for"))
    return max(needs, key=lambda need: need.share)


def _over_half(values: Array) -> Array:
    """Return the largest size (n,) of the means of values (N, n) over half a swing."""
    half = INSTANTS // 2
    sums = np.cumsum(np.vstack([np.zeros(values.shape[1]), values]), axis=0)
    return np.asarray(np.abs(sums[half:] - sums[:-half]).max(axis=0) / half)
