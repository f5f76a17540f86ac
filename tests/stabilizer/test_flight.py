"""Flight: noticed when no sole has felt the ground for a while; no step begins until one does."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.flight import FLIGHT_TIME, PAUSE, UNFELT, Flight, feel, waiting

PLAN = pw.FootstepPlanner(0.25, 0.17, 0.9).generate_footsteps(4)


def test_a_flight_begins_after_a_while_and_ends_with_the_first_touch() -> None:
    flight = feel(Flight(), 0.0, 0.0)  # the first sense of a run knows nothing yet
    assert not flight.flies
    assert feel(flight, 1.01 * FLIGHT_TIME, 0.0).flies  # though no ground was ever felt
    flight = feel(flight, 1.0, 1.0)
    assert not feel(flight, 1.0 + 0.99 * FLIGHT_TIME, 0.0).flies
    flight = feel(flight, 1.0 + 1.01 * FLIGHT_TIME, 0.5 * UNFELT)
    assert flight.flies
    assert feel(flight, 2.0, 0.0).flies
    assert feel(flight, 2.0, 2.0 * UNFELT) == Flight(2.0)


def test_the_next_step_waits_and_all_others_with_it() -> None:
    step = PLAN.steps[1]
    assert waiting(PLAN, step.lift - 0.51 * PAUSE) is None
    t = step.lift - 0.1
    held = waiting(PLAN, t)
    assert held is not None
    assert held.steps[0] == PLAN.steps[0]
    delay = t + PAUSE - step.lift
    for before, after in zip(PLAN.steps[1:], held.steps[1:], strict=True):
        assert after.lift == pytest.approx(before.lift + delay)
        assert after.land == pytest.approx(before.land + delay)
        assert after.pose is before.pose
    assert waiting(held, t) is None


def test_nothing_waits_at_the_end_of_a_plan() -> None:
    assert waiting(PLAN, PLAN.end) is None


def lifted(robot: Robot, t: float, duration: float) -> tuple[pw.Walk, Record]:
    """Walk and be lifted at the CoM by a little more than the weight."""
    time = 3.13 * (robot.leg_length / robot.gravity) ** 0.5
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, time)
    com = pin.centerOfMass(robot.pin, robot.pin.createData(), robot.posture)
    point = pin.XYZQUATToSE3(robot.posture[:7]).actInv(com)
    force = (0.0, 0.0, 1.02 * robot.mass * robot.gravity)
    push = pw.Push(t, duration, force, point=tuple(point))
    walk = pw.Walk(robot, planner.generate_footsteps(8, ramp=2), pushes=[push]).run()
    return walk, walk.record()


def test_no_foot_lifts_in_flight(talos: Robot) -> None:
    """Lifted for so long that two steps would be made in the air; how it lands is another thing."""
    _, record = lifted(talos, 3.0, 0.8)
    flying = (record.time > 3.3) & (record.time < 3.9) & (record.phase == -1)
    assert flying.sum() > 100
    lifts = np.diff(record.phase_ref[flying]) > 0
    assert not lifts.any()


def test_after_a_short_flight_the_walk_goes_on_to_its_end(talos: Robot) -> None:
    walk, record = lifted(talos, 3.0, 0.3)
    assert (record.phase[record.time > 3.0] == -1).sum() > 100
    assert not walk.fallen
    assert record.phase[-1] == 0
    assert record.time[-1] >= walk.plan.end
    assert {"left", "right"} == {step.foot for step in walk.plan.steps if step.lift > 3.4}
