"""Flight: noticed when no sole has felt the ground for a while; the landing is caught."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.geometry.poses import compose, heading_of, midfeet, pose_at, relative
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.flight import (
    CATCH,
    CLEAR,
    FLIGHT_TIME,
    PAUSE,
    UNFELT,
    Flight,
    feel,
    stand_on,
    waiting,
)

PLAN = pw.FootstepPlanner(0.25, 0.17, 0.9).generate_footsteps(4)


def test_a_flight_begins_after_a_while_and_ends_with_the_first_touch() -> None:
    flight = feel(Flight(), 0.0, 0.0, 1.0, False)  # the first sense of a run knows nothing yet
    assert not flight.flies
    # Though no ground was ever felt.
    assert feel(flight, 1.01 * FLIGHT_TIME, 0.0, 1.0, False).flies
    flight = feel(flight, 1.0, 1.0, 0.0, False)
    assert not feel(flight, 1.0 + 0.99 * FLIGHT_TIME, 0.0, 1.0, False).flies
    flight = feel(flight, 1.0 + 1.01 * FLIGHT_TIME, 0.5 * UNFELT, 2.0 * CLEAR, False)
    assert flight.flies
    assert flight.airborne
    assert feel(flight, 2.0, 0.0, 0.0, False).airborne
    assert feel(flight, 2.0, 2.0 * UNFELT, 0.0, False) == Flight(2.0)


def test_soles_on_the_ground_whose_sensors_are_dead_do_not_fly_off() -> None:
    flight = feel(feel(Flight(), 0.0, 1.0, 0.0, False), 1.0, 0.0, 0.5 * CLEAR, False)
    assert flight.flies
    assert not flight.airborne


def test_who_is_lifted_flies_at_once_whatever_the_soles_feel() -> None:
    assert feel(Flight(0.0), 0.001, 0.2, 0.0, True).airborne


@pytest.mark.parametrize("t", [0.5, PLAN.steps[1].lift + 0.2])
def test_after_a_landing_the_steps_go_on_from_where_the_robot_has_come_down(t: float) -> None:
    """In a stand and in mid swing: the sole in the air counts as down, the rest moves with it."""
    soles = {"left": pose_at(1.0, 2.1, 0.7, 0.01), "right": pose_at(1.1, 1.9, 0.5, 0.01)}
    plan = stand_on(PLAN, t, soles)
    assert plan.start == t
    assert [step.foot for step in plan.steps] == [s.foot for s in PLAN.steps if s.lift > t]
    assert plan.steps[0].lift >= t + CATCH * PLAN.weight_shift - 1e-9
    swing = PLAN.swing_at(t)
    later = t if swing is None else swing.land
    before = midfeet(PLAN.sole("left", later), PLAN.sole("right", later))
    now = midfeet(soles["left"], soles["right"])
    for step, old in zip(plan.steps, PLAN.steps[-len(plan.steps) :], strict=True):
        assert step.land - step.lift == pytest.approx(old.land - old.lift)
        place = compose(now, *relative(before, heading_of(old.pose)))
        assert heading_of(step.pose) == pytest.approx(place)
        assert step.pose[2, 3] == pytest.approx(old.pose[2, 3])


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
    walk = pw.Walk(robot, planner.generate_footsteps(4, ramp=1), pushes=[push]).run()
    return walk, walk.record()


def test_a_long_flight_is_landed_and_the_walk_goes_on(talos: Robot) -> None:
    """Lifted so long that the next step would be made in the air, and let down from 0.2 m."""
    walk, record = lifted(talos, 1.8, 0.8)
    flying = record.phase == -1
    assert record.left_foot[flying, 2, 3].max() > 0.15
    assert not record.phase_ref[flying & (record.time > 1.85)].any(), "no step in the air"
    tilt = record.torso_tilt[record.time > 1.8]
    assert not walk.fallen
    assert tilt.max() < 0.15
    assert record.phase[-1] == 0
    assert {"left", "right"} == {step.foot for step in walk.plan.steps}


def test_a_robot_that_stands_is_lifted_and_stands_again() -> None:
    g1 = pw.load_robot("g1")
    force = (0.0, 0.0, 1.2 * g1.mass * g1.gravity)
    com = pin.centerOfMass(g1.pin, g1.pin.createData(), g1.posture)
    point = tuple(pin.XYZQUATToSE3(g1.posture[:7]).actInv(com))
    walk = pw.Walk.standing(g1, pushes=[pw.Push(0.2, 0.4, force, point=point)]).run(until=2.5)
    record = walk.record()
    assert record.left_foot[:, 2, 3].max() > 0.15
    assert not walk.fallen
    assert np.abs(record.com_velocity[-1]).max() < 0.02


def test_after_a_short_flight_the_walk_goes_on_to_its_end(talos: Robot) -> None:
    walk, record = lifted(talos, 2.0, 0.3)
    assert (record.phase[record.time > 2.0] == -1).sum() > 100
    assert not walk.fallen
    assert record.phase[-1] == 0
    assert record.time[-1] >= walk.plan.end
    assert {"left", "right"} == {step.foot for step in walk.plan.steps if step.lift > 2.4}
