"""Whole walks: what the robot did, held to what was asked, and to Newton."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.analysis.summary import torque_ratios
from preview_walk.errors import InvalidInput
from preview_walk.planning.footsteps import FootstepPlan
from preview_walk.planning.gaits import straight
from preview_walk.planning.pose import pose_at
from preview_walk.planning.support import Sole, support_margin, support_polygon
from preview_walk.robots.contact_sensor import zmp
from preview_walk.robots.robot import Robot
from preview_walk.simulation.record import Record
from preview_walk.simulation.walk import STAND_AFTER
from preview_walk.tracking.gains import TrackingGains
from preview_walk.types import FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array

SUPPORT = {"left": LEFT_SUPPORT, "right": RIGHT_SUPPORT}


def assert_within_the_bars(record: Record) -> None:
    """Hold a walk to the figures that the default walk must reach."""
    summary = record.summary()
    assert not summary.fell, summary.fall_reason
    assert summary.final_position_error is not None
    assert summary.final_yaw_error is not None
    assert summary.final_position_error <= 0.03
    assert summary.final_yaw_error <= 0.03
    assert max(x or np.inf for x in summary.com_error_rms[:2]) <= 0.005
    assert max(x or np.inf for x in summary.zmp_error_rms) <= 0.015
    assert summary.qp_failures == 0


def tilt(pose: Array) -> Array:
    """Return the angle (N,) between the z axes of poses (N, 4, 4) and the vertical."""
    return np.asarray(np.arccos(np.clip(pose[:, 2, 2], -1.0, 1.0)))


def supports(record: Record, foot: str) -> list[slice]:
    """Return the ticks of each planned single support of a foot."""
    alone = np.concatenate([[0], record.phase_ref == SUPPORT[foot], [0]]).astype(int)
    return [slice(a, b) for a, b in np.flatnonzero(np.diff(alone)).reshape(-1, 2)]


def test_the_default_walk_is_within_its_bars(default_walk: Record) -> None:
    assert_within_the_bars(default_walk)
    summary = default_walk.summary()
    assert summary.steps == 20
    assert summary.speed == pytest.approx(0.25 / 0.9, rel=0.02)
    assert summary.torque_ratio_max is not None
    assert summary.torque_ratio_max <= 0.7
    assert len(default_walk.plans) == 1  # no step was moved: nobody pushed
    assert default_walk.com[-1, 0] == pytest.approx(4.25, abs=0.02)


def test_it_looks_like_walking(default_walk: Record) -> None:
    """No slip, no shaking, feet flat and gently down, knees bent, arms quiet, trunk upright."""
    r = default_walk
    for foot in FEET:
        pose, force = getattr(r, f"{foot}_foot"), getattr(r, f"{foot}_force")[:, 2]
        yaw = np.unwrap(np.arctan2(pose[:, 1, 0], pose[:, 0, 0]))
        for alone in supports(r, foot):
            assert np.ptp(pose[alone, :2, 3], axis=0).max() < 1e-3
            assert np.ptp(yaw[alone]) < np.radians(0.3)
        assert tilt(pose).max() < np.radians(1.0)
        landed = np.flatnonzero((force[1:] > 20.0) & (force[:-1] <= 20.0))
        assert np.gradient(pose[:, 2, 3], r.dt)[landed].min() > -0.15
        assert force.max() < 1.2 * r.settings["mass"] * r.settings["gravity"]
        assert pose[:, 2, 3].max() > 0.04
        assert pose[:, 2, 3].min() > -0.005
    names = r.settings["joint_names"]
    joints = {name: r.q[:, 7 + k] for k, name in enumerate(names)}
    for knee in ("leg_left_4_joint", "leg_right_4_joint"):
        assert joints[knee].min() > np.radians(20.0)
    assert max(np.ptp(angle) for name, angle in joints.items() if "arm" in name) < np.radians(6.0)
    assert r.torso_tilt.max() < np.radians(2.0)
    assert np.abs(np.diff(r.tau, axis=0)).mean() < 0.3  # N·m from tick to tick


def test_the_record_holds_what_was_planned_and_what_was_measured(default_walk: Record) -> None:
    r = default_walk
    assert np.diff(r.time) == pytest.approx(r.dt)
    assert r.time[-1] == pytest.approx(r.plans[-1].end + STAND_AFTER, abs=2 * r.dt)
    for name, array in r.arrays().items():
        assert len(array) == len(r)
        # The ZMP has no meaning before the first contact force is measured.
        assert np.isfinite(array[1:]).all(), name
    assert (torque_ratios(r)[:, r.tau.any(axis=0)] <= 1.0 + 1e-12).all()
    assert (r.phase == r.phase_ref).mean() > 0.98
    k = len(r) // 2
    omega = r.com_velocity[k, :2] / (r.dcm - r.com[:, :2])[k]
    assert r.dcm == pytest.approx(r.com[:, :2] + r.com_velocity[:, :2] / omega, abs=1e-9)
    assert r.dcm_ref == pytest.approx(
        r.com_ref[:, :2] + r.com_velocity_ref[:, :2] / omega, abs=1e-9
    )
    for foot in FEET:
        measured, planned = getattr(r, f"{foot}_foot"), getattr(r, f"{foot}_foot_ref")
        assert np.abs(measured - planned)[:, :3, 3].max() < 0.01
        assert planned[-1] == pytest.approx(r.plans[-1].last_pose(foot), abs=1e-9)


def test_the_zmp_is_that_of_the_forces_and_on_the_soles(default_walk: Record) -> None:
    r, sole = default_walk, Sole(*default_walk.settings["sole"])
    for k in range(1, len(r), 50):
        wrenches = (r.left_force[k], r.right_force[k])
        feet = (r.left_foot[k], r.right_foot[k])
        assert r.zmp[k] == pytest.approx(
            zmp(wrenches, (feet[0][:3, 3], feet[1][:3, 3]), 0.0), abs=2e-3
        )
        down = [pose for pose, force in zip(feet, wrenches, strict=True) if force[2] > 1.0]
        assert support_margin(support_polygon(down, sole), r.zmp[k]) > -1e-3


def test_nothing_moves_the_robot_but_its_feet(talos: Robot, short_plan: FootstepPlan) -> None:
    """m dv/dt of the CoM is the sum of what the soles measure and of gravity, at every tick."""
    record = pw.simulate(talos, short_plan, physics_hz=1000, control_hz=1000)
    weight = np.array((0.0, 0.0, -9.81 * talos.mass))
    force = record.left_force[:, :3] + record.right_force[:, :3]
    # What is sensed at a tick acted during the physics step before it.
    change = talos.mass * np.diff(record.com_velocity, axis=0) / record.dt
    error = force[1:] + weight - change
    assert np.abs(force[:, 2]).max() > talos.mass * 9.81
    assert np.sqrt((error**2).mean(axis=0)).max() < 2.0
    # And over the whole walk, from rest to rest, nothing is left.
    assert np.abs(error.mean(axis=0)).max() < 0.2
    assert_within_the_bars(record)


def test_two_runs_are_the_same_bit_for_bit(
    talos: Robot, short_plan: FootstepPlan, short_walk: Record
) -> None:
    """Also when the second is driven in pieces."""
    walk = pw.Walk(talos, short_plan)
    for time in (0.001, 0.75, 0.75, 2.4321, 3.0):
        walk.run(until=time)
    for _ in range(10):
        walk.tick()
    assert not walk.finished
    walk = walk.run()
    assert walk.finished
    again = walk.record()
    assert again.differences(short_walk) == ()


def test_walks_the_same_anywhere_in_any_direction(talos: Robot, short_walk: Record) -> None:
    start = (100.0, -50.0, np.radians(137.0))
    planner = pw.FootstepPlanner(0.25, talos.step_width, 0.8)
    away = pw.simulate(talos, planner.generate_footsteps(5, start, ramp=1))
    by = pose_at(*start)
    expected = short_walk.com @ by[:3, :3].T + by[:3, 3]
    assert np.abs(away.com - expected).max() < 1e-4
    assert away.tau == pytest.approx(short_walk.tau, abs=2.0)
    assert away.summary().com_error_rms == pytest.approx(
        short_walk.summary().com_error_rms, rel=0.02
    )


def test_walks_on_a_floor_of_friction_a_half(talos: Robot, short_plan: FootstepPlan) -> None:
    record = pw.simulate(talos, short_plan, friction=0.5)
    assert_within_the_bars(record)
    assert record.settings["friction"] == 0.5
    for foot in FEET:
        force = getattr(record, f"{foot}_force")
        loaded = force[force[:, 2] > 20.0]
        assert (np.hypot(loaded[:, 0], loaded[:, 1]) <= 0.5 * loaded[:, 2] + 1e-6).all()


@pytest.mark.parametrize(("physics_hz", "control_hz"), [(500, 500), (1000, 250), (2000, 400)])
def test_other_rates_walk_too(
    talos: Robot, short_plan: FootstepPlan, physics_hz: int, control_hz: int
) -> None:
    record = pw.simulate(talos, short_plan, physics_hz=physics_hz, control_hz=control_hz)
    assert record.dt == 1.0 / control_hz
    assert_within_the_bars(record)


def test_walks_at_0_8_metres_a_second(talos: Robot) -> None:
    planner = pw.FootstepPlanner(0.5, talos.step_width, 0.62, 0.05)
    record = pw.simulate(talos, planner.generate_footsteps(20, ramp=5))
    summary = record.summary()
    assert not summary.fell
    assert summary.speed is not None
    assert summary.speed > 0.79
    # It ends where it was sent, not just where the last revision of the plan says.
    for foot in FEET:
        end = getattr(record, f"{foot}_foot")[-1]
        assert np.linalg.norm((end - record.plans[0].last_pose(foot))[:2, 3]) < 0.05


def test_a_fall_ends_the_run_and_the_record_stays(talos: Robot, short_plan: FootstepPlan) -> None:
    push = pw.Push(t=2.0, duration=0.2, force=(0.0, 900.0, 0.0))
    walk = pw.Walk(talos, short_plan, pushes=[push])
    record = walk.run().record()
    assert walk.fallen
    assert walk.finished
    assert record.settings["fell"]
    assert not record.settings["interrupted"]
    reason = record.settings["fall_reason"]
    assert re.fullmatch(
        r"the torso leaned \d+ degrees|the CoM sank to \d\.\d\d m of 0\.88 m above the feet", reason
    )
    fall = record.settings["fall_time"]
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
    assert record.settings["interrupted"]
    assert not record.settings["fell"]
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
    assert record.settings["seed"] == 5
    heading = np.arctan2(record.left_foot[-1, 1, 0], record.left_foot[-1, 0, 0])
    assert heading == pytest.approx(0.7, abs=1e-3)
    weight = talos.mass * 9.81
    carried = record.left_force[-1] + record.right_force[-1]
    assert carried[2] == pytest.approx(weight, rel=1e-3)


def test_the_record_knows_what_the_run_was_made_of(talos: Robot, short_plan: FootstepPlan) -> None:
    gains = TrackingGains(dcm=5.0)
    push = pw.Push(1.0, 0.1, (1.0, 2.0, 3.0), point=(0.0, 0.0, 0.3))
    walk = pw.Walk(talos, short_plan, pushes=[push], gains=gains, seed=3, friction=0.7)
    settings = walk.run(until=0.1).record().settings
    assert settings["robot"] == "talos"
    assert settings["mass"] == talos.mass
    assert settings["tau_max"] == talos.effort.tolist()
    assert settings["joint_names"] == list(talos.joint_names)
    assert (settings["seed"], settings["friction"], settings["solver"]) == (3, 0.7, "osqp")
    assert (settings["physics_hz"], settings["control_hz"]) == (1000, 500)
    assert settings["pushes"][0]["point"] == [0.0, 0.0, 0.3]
    assert settings["gains"]["dcm"] == 5.0


def test_another_solver_walks_the_same_way(talos: Robot, short_walk: Record) -> None:
    """DAQP is exact: torques and motion agree with what the persistent OSQP makes of them."""
    planner = pw.FootstepPlanner(0.25, talos.step_width, 0.8)
    walk = pw.Walk(talos, planner.generate_footsteps(5, ramp=1), solver="daqp")
    record = walk.run(until=3.0).record()
    n = len(record)
    assert np.abs(record.com - short_walk.com[:n]).max() < 1e-3
    assert np.sqrt(((record.tau - short_walk.tau[:n]) ** 2).mean()) < 0.5


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"friction": 0.0}, "friction must be > 0, got 0.0."),
        ({"friction": float("nan")}, "friction must be > 0, got nan."),
        (
            {"physics_hz": 1000, "control_hz": 300},
            "physics_hz must be a positive multiple of control_hz, got 1000 and 300.",
        ),
        (
            {"physics_hz": 0, "control_hz": 500},
            "physics_hz must be a positive multiple of control_hz, got 0 and 500.",
        ),
    ],
)
def test_bad_settings_are_refused(
    talos: Robot, short_plan: FootstepPlan, settings: dict[str, float], sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        pw.simulate(talos, short_plan, **settings)  # type: ignore[arg-type]
