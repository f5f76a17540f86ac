"""How a run begins, is changed, and ends: by itself, by a fall, by Ctrl-C."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from walk_bars import assert_within_the_bars

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.gaits import straight
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.robots.robot import Robot
from preview_walk.simulation.walk import STAND_AFTER
from preview_walk.tracking.gains import TrackingGains


def test_a_fall_ends_the_run_and_the_record_stays(talos: Robot, short_plan: FootstepPlan) -> None:
    push = pw.Push(t=2.0, duration=0.2, force=(0.0, 900.0, 0.0))
    walk = pw.Walk(talos, short_plan, pushes=[push])
    record = walk.run().record()
    assert walk.fallen
    assert walk.finished
    assert record.run.fell
    assert not record.run.interrupted
    reason = record.run.fall_reason
    assert re.fullmatch(
        r"the torso leaned \d+ degrees|the CoM sank to \d\.\d\d m of 0\.88 m above the feet", reason
    )
    fall = record.run.fall_time
    assert 2.0 < fall < 4.0
    assert record.time[-1] == pytest.approx(fall)
    assert np.isfinite(record.com).all()
    assert np.isfinite(record.tau).all()
    summary = record.summary()
    assert (summary.fell, summary.fall_time, summary.fall_reason) == (True, fall, reason)
    length = len(record)
    assert len(walk.run().record()) == length  # it does not get up again


def test_ctrl_c_ends_the_run_and_the_record_stays(talos: Robot, short_plan: FootstepPlan) -> None:
    seen = []

    def progress(time: float, end: float) -> None:
        seen.append((time, end))
        if time > 1.0:
            raise KeyboardInterrupt

    record = pw.simulate(talos, short_plan, progress=progress)
    assert record.run.interrupted
    assert not record.run.fell
    assert record.time[-1] == pytest.approx(seen[-1][0] - record.dt)
    assert all(np.isfinite(array[1:]).all() for array in (record.q, record.zmp, record.tau))
    assert record.summary().final_position_error is None
    times, ends = np.array(seen).T
    assert (np.diff(times) > 0.0).all()
    assert ends == pytest.approx(short_plan.end + STAND_AFTER)


def test_an_interrupted_walk_does_not_go_on(talos: Robot, short_plan: FootstepPlan) -> None:
    """A run in pieces, as under commands, ends at the first Ctrl-C."""

    def progress(time: float, end: float) -> None:
        raise KeyboardInterrupt

    walk = pw.Walk(talos, short_plan)
    walk.run(until=0.5, progress=progress)
    assert walk.finished
    stopped = walk.time
    walk.run(until=1.0)
    assert walk.time == stopped


def test_another_plan_takes_over_at_any_moment(talos: Robot, short_plan: FootstepPlan) -> None:
    """In the middle of a step the walk is told to end here, and then to go back half a metre."""
    walk = pw.Walk(talos, short_plan)
    walk.run(until=short_plan.steps[2].lift + 0.2)
    kept = walk.plan.replace_after(walk.time, [])
    planner = pw.FootstepPlanner(0.2, talos.step_width, 0.8)
    walk.plan = straight(-0.5, planner, start=kept, limits=walk.limits)
    record = walk.run().record()
    assert_within_the_bars(record)
    assert len(record.plans) == 2
    assert record.plans[0].end == short_plan.end
    assert record.plans[-1].end == walk.plan.end
    assert record.com[-1, 0] < record.com[:, 0].max() - 0.4


def test_a_plan_may_begin_at_any_time(talos: Robot, short_plan: FootstepPlan) -> None:
    """The clock of a run is its plan's, also for the pushes."""
    later = FootstepPlan([replace(s, lift=s.lift + 64.0, land=s.land + 64.0) for s in short_plan])
    push = pw.Push(t=64.5, duration=0.1, force=(20.0, 0.0, 0.0))
    walk = pw.Walk(talos, later, pushes=[push])
    assert walk.time == 64.0
    record = walk.run(until=65.0).record()
    assert record.time[0] == 64.0
    pushed = record.time[record.push[:, 0] > 0.0]
    assert len(pushed) == 50
    assert pushed[0] == pytest.approx(64.5, abs=2 * record.dt)


def test_stands_where_it_is_told(talos: Robot) -> None:
    walk = pw.Walk.standing(talos, (2.0, -1.0, 0.7), seed=5)
    assert not walk.finished
    walk = walk.run()
    assert walk.finished
    record = walk.record()
    assert record.time[-1] == pytest.approx(STAND_AFTER, abs=2 * record.dt)
    assert record.com[-1, :2] == pytest.approx((2.0, -1.0), abs=2e-3)
    assert record.run.seed == 5
    heading = np.arctan2(record.left_foot[-1, 1, 0], record.left_foot[-1, 0, 0])
    assert heading == pytest.approx(0.7, abs=1e-3)
    weight = talos.mass * 9.81
    carried = record.left_force[-1] + record.right_force[-1]
    assert carried[2] == pytest.approx(weight, rel=1e-3)


def test_the_record_knows_what_the_run_was_made_of(talos: Robot, short_plan: FootstepPlan) -> None:
    gains = TrackingGains(dcm=5.0)
    push = pw.Push(1.0, 0.1, (1.0, 2.0, 3.0), point=(0.0, 0.0, 0.3))
    walk = pw.Walk(talos, short_plan, pushes=[push], gains=gains, seed=3, friction=0.7)
    record = walk.run(until=0.1).record()
    run = record.run
    assert run.robot == "talos"
    assert run.mass == talos.mass
    assert run.tau_max == tuple(talos.effort.tolist())
    assert run.joint_names == tuple(talos.joint_names)
    assert (run.seed, run.friction, run.solver) == (3, 0.7, "osqp")
    assert (run.physics_hz, run.control_hz) == (1000, 500)
    assert run.pushes[0]["point"] == (0.0, 0.0, 0.3)
    assert run.gains["dcm"] == 5.0
    assert run.swing_height == walk.walker.swing_height
    dcm = record.com[:, :2] + record.com_velocity[:, :2] / run.omega
    np.testing.assert_array_equal(record.dcm, dcm)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"friction": 0.0}, "friction must be between 0.001 and 10, got 0.0."),
        ({"friction": float("nan")}, "friction must be between 0.001 and 10, got nan."),
        (
            {"physics_hz": 1000, "control_hz": 300},
            "physics_hz must be a positive multiple of control_hz, got 1000 and 300.",
        ),
        (
            {"physics_hz": 0, "control_hz": 500},
            "physics_hz must be between 1 and 100000 per second, got 0.",
        ),
    ],
)
def test_bad_settings_are_refused(
    talos: Robot, short_plan: FootstepPlan, settings: dict[str, float], sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        pw.simulate(talos, short_plan, **settings)  # type: ignore[arg-type]
