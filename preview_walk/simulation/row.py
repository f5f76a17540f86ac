"""What a walk writes into its record: the run's facts once, and a row at every tick."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from preview_walk.controller.feet import CONTACT_FORCE, sole_pose
from preview_walk.controller.walker import Walker
from preview_walk.record.recorder import package_versions
from preview_walk.record.run_facts import RunFacts
from preview_walk.robots.building.contact_sensor import zmp
from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.world import World
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array, Foot

NO_CONTACT = -1
"""Measured phase of a robot that neither foot carries."""


def run_settings(
    robot: Robot, pushes: Sequence[Push], world: World, walker: Walker, **settings: Any
) -> RunFacts:
    """Return the facts that a record of this run keeps, with `settings` added."""
    sole = robot.soles["left"]
    return RunFacts(
        robot=robot.name,
        title=robot.title,
        mass=robot.mass,
        gravity=float(np.linalg.norm(world.model.opt.gravity)),
        joint_names=tuple(robot.joint_names),
        tau_max=tuple(robot.effort.tolist()),
        com_height=robot.com_height,
        leg_length=robot.leg_length,
        step_width=robot.step_width,
        sole=(sole.half_length, sole.half_width),
        omega=walker.pattern.omega,
        swing_height=walker.swing_height,
        pushes=tuple(asdict(push) for push in pushes),
        versions=package_versions(),
        **settings,
    )


def tick_row(
    t: float, world: World, walker: Walker, torques: Array, spent: float
) -> dict[str, Any]:
    """Return the record's fields of the tick at time t (s) that sent `torques` (n,) in N·m.

    `spent` is the wall time (s) of the whole tick.
    """
    body, dynamics, reference = walker.body, walker.body.dynamics, walker.reference
    assert reference is not None
    assert body.solution is not None
    left, right = dynamics.soles["left"], dynamics.soles["right"]
    planned = _planned_wrenches(walker, body.solution.wrench)
    upright = float(dynamics.torso.rotation[2, 2])
    return {
        "time": t,
        "q": world.q,
        "v": world.v,
        "tau": torques,
        "com": dynamics.com,
        "com_ref": reference.com,
        "com_velocity": dynamics.com_velocity,
        "com_velocity_ref": reference.velocity,
        "com_acceleration_ref": reference.acceleration,
        "dcm": dynamics.com[:2] + dynamics.com_velocity[:2] / walker.pattern.omega,
        "dcm_ref": reference.dcm,
        "zmp": zmp(
            (world.wrench["left"], world.wrench["right"]),
            (left.position, right.position),
            reference.ground,
        ),
        "zmp_ref": reference.zmp_ref,
        "zmp_preview": reference.zmp,
        "left_foot": sole_pose(left),
        "right_foot": sole_pose(right),
        "left_foot_ref": walker.feet["left"].pose,
        "right_foot_ref": walker.feet["right"].pose,
        "left_force": world.wrench["left"],
        "right_force": world.wrench["right"],
        "left_force_ref": planned["left"],
        "right_force_ref": planned["right"],
        "push": world.push,
        "torso_tilt": np.arccos(min(1.0, max(-1.0, upright))),
        "phase": _phase(world, CONTACT_FORCE * walker.weight),
        "phase_ref": walker.plan.support(t),
        "qp_iterations": body.solution.iterations,
        "qp_status": body.status,
        "tick_time": spent,
        "terms_time": body.times.terms,
        "assembly_time": body.times.assembly,
        "qp_time": body.times.solve,
    }


def _phase(world: World, threshold: float) -> int:
    """Return the support phase that the force sensors show; a sole stands above `threshold` (N)."""
    left, right = (world.wrench[foot][2] > threshold for foot in FEET)
    if left:
        return DOUBLE_SUPPORT if right else LEFT_SUPPORT
    return RIGHT_SUPPORT if right else NO_CONTACT


def _planned_wrenches(walker: Walker, wrench: Array) -> dict[Foot, Array]:
    """Return the contact wrenches (6,) of the tick's QP at the soles' centres, in world axes.

    `wrench` (6 per foot in contact, left first) has them in the axes of each sole.
    """
    planned: dict[Foot, Array] = {foot: np.zeros(6) for foot in FEET}
    for k, foot in enumerate(f for f in FEET if walker.feet[f].contact):
        rotation = walker.body.dynamics.soles[foot].rotation
        planned[foot][:3] = rotation @ wrench[6 * k : 6 * k + 3]
        planned[foot][3:] = rotation @ wrench[6 * k + 3 : 6 * k + 6]
    return planned
