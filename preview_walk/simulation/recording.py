"""What a walk records: the run's settings once, a row at every tick, its end."""

from __future__ import annotations

import os
from dataclasses import asdict
from math import nan
from typing import Any

import numpy as np

from preview_walk.controller.feet import CONTACT_FORCE
from preview_walk.controller.walker import Walker
from preview_walk.reality.realism import plain_values
from preview_walk.record.record import Record
from preview_walk.record.recorder import Recorder, package_versions
from preview_walk.record.run_facts import RunFacts
from preview_walk.robots.building.contact_sensor import zmp
from preview_walk.simulation.plant import Plant
from preview_walk.simulation.rates import ticks_per_row
from preview_walk.simulation.real_world import RealWorld
from preview_walk.simulation.seeing import EstimatedSight, PerfectSight
from preview_walk.terrain.facts import facts_of
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array

NO_CONTACT = -1
"""Measured phase of a robot that neither foot carries."""


def run_facts(plant: Plant, walker: Walker, **facts: Any) -> RunFacts:
    """Return what a record of this run says of it, with `facts` added."""
    robot = plant.robot
    return RunFacts(
        robot=robot.name,
        title=robot.title,
        mass=robot.mass,
        gravity=robot.gravity,
        joint_names=robot.joint_names,
        tau_max=tuple(robot.effort.tolist()),
        com_height=robot.com_height,
        leg_length=robot.leg_length,
        step_width=robot.step_width,
        sole=(robot.sole.half_length, robot.sole.half_width),
        omega=walker.pattern.omega,
        com_generator=walker.pattern.com_generator,
        swing_height=walker.swing_height,
        physics_hz=1.0 / plant.timestep,
        friction=plant.friction,
        ground=facts_of(plant.ground),
        blind=walker.blind,
        realism=plain_values(plant.realism) if isinstance(plant, RealWorld) else {},
        gains=asdict(walker.gains),
        versions=package_versions(),
        **facts,
    )


class WalkRecorder:
    """Records a plant and the walker that drives it, tick by tick."""

    def __init__(
        self,
        plant: Plant,
        walker: Walker,
        sight: PerfectSight | EstimatedSight,
        *,
        control_hz: float,
        record_hz: float | None = None,
        blocks: str | os.PathLike[str] | None = None,
        **facts: Any,
    ) -> None:
        """Note what the run is made of.

        Args:
            plant: what is sensed and driven.
            walker: the controller.
            sight: what it sees of the plant.
            control_hz: ticks of the controller per second.
            record_hz: rows per second; None: one at every tick.
            blocks: folder that the rows are written to as they come; None: none.
            facts: seed, solver.

        Raises:
            InvalidInput: a rate of rows that does not fit to that of ticks.
            OutputError: the folder cannot be made or written to.
        """
        self._every, self._ticks = ticks_per_row(control_hz, record_hz), 0
        facts["record_hz"] = nan if self._every == 1 else control_hz / self._every
        self._plant, self._walker, self._sight = plant, walker, sight
        model = plant.robot.pin
        sizes = {"nq": model.nq, "nv": model.nv, "nu": model.nv - 6}
        run = run_facts(plant, walker, control_hz=control_hz, **facts)
        self._recorder = Recorder(run, sizes, blocks=blocks)

    def write(self, t: float, torques: Array, spent: float) -> None:
        """Note the tick at time t (s) that sent `torques` (n,), N·m, after `spent` seconds."""
        self._recorder.plan(t, self._walker.plan)
        self._ticks += 1
        if (self._ticks - 1) % self._every:
            return
        self._recorder.write(**tick_row(t, self._plant, self._walker, torques, spent))
        if isinstance(self._sight, EstimatedSight):
            self._recorder.sensed(**self._sight.row())

    def finish(self, fall: tuple[float, str] | None, interrupted: bool, **facts: Any) -> Record:
        """Return the record so far.

        Args:
            fall: time (s) and reason of a fall, or None.
            interrupted: whether the run was stopped before its end.
            facts: what else came out: wall_time, retuned.
        """
        time, reason = fall or (None, None)
        return self._recorder.finish(
            fell=fall is not None,
            fall_time=time,
            fall_reason=reason,
            interrupted=interrupted,
            pushes=tuple(asdict(push) for push in self._plant.pushes),
            **facts,
        )


def tick_row(
    t: float, plant: Plant, walker: Walker, torques: Array, spent: float
) -> dict[str, Any]:
    """Return the record's fields of one tick, by name.

    Args:
        t: time of the tick, s.
        plant: as sensed at t.
        walker: after its tick.
        torques: (n,) that it sent, N·m.
        spent: wall time of the whole tick, s.
    """
    body, dynamics, reference = walker.body, walker.body.dynamics, walker.reference
    assert body.solution is not None
    left, right = dynamics.soles["left"], dynamics.soles["right"]
    upright = float(dynamics.torso.rotation[2, 2])
    return {
        "time": t,
        "q": plant.q,
        "v": plant.v,
        "tau": torques,
        "com": dynamics.com,
        "com_ref": reference.com,
        "com_velocity": dynamics.com_velocity,
        "com_velocity_ref": reference.velocity,
        "com_acceleration_ref": reference.acceleration,
        "dcm": dynamics.com[:2] + dynamics.com_velocity[:2] / walker.pattern.omega,
        "dcm_ref": reference.dcm,
        "zmp": zmp(
            (plant.wrench["left"], plant.wrench["right"]),
            (left.position, right.position),
            reference.ground,
        ),
        "zmp_ref": reference.zmp_ref,
        "zmp_preview": reference.zmp,
        "left_foot": left.pose,
        "right_foot": right.pose,
        "left_foot_ref": walker.feet.targets["left"].pose,
        "right_foot_ref": walker.feet.targets["right"].pose,
        "left_force": plant.wrench["left"],
        "right_force": plant.wrench["right"],
        "left_force_ref": body.wrench("left"),
        "right_force_ref": body.wrench("right"),
        "push": plant.push,
        "torso_tilt": np.arccos(min(1.0, max(-1.0, upright))),
        "phase": _phase(plant, CONTACT_FORCE * walker.weight),
        "phase_ref": walker.plan.support(t),
        "qp_iterations": body.solution.iterations,
        "qp_status": body.status,
        "qp_solver": body.solution.finished,
        "tick_time": spent,
        "terms_time": body.times.terms,
        "assembly_time": body.times.assembly,
        "qp_time": body.times.solve,
    }


def _phase(plant: Plant, threshold: float) -> int:
    """Return the support phase that the force sensors show; a sole stands above `threshold` (N)."""
    left, right = (plant.wrench[foot][2] > threshold for foot in FEET)
    if left:
        return DOUBLE_SUPPORT if right else LEFT_SUPPORT
    return RIGHT_SUPPORT if right else NO_CONTACT
