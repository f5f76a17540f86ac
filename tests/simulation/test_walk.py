"""Whole walks: what the robot did, held to what was asked, and to Newton."""

from __future__ import annotations

import numpy as np
import pytest
from walk_bars import assert_within_the_bars

import preview_walk as pw
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole, support_margin, support_polygon
from preview_walk.record.record import Record
from preview_walk.record.summarize import torque_ratios
from preview_walk.robots.building.contact_sensor import zmp
from preview_walk.robots.robot import Robot
from preview_walk.simulation.walk import STAND_AFTER
from preview_walk.types import FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array

SUPPORT = {"left": LEFT_SUPPORT, "right": RIGHT_SUPPORT}


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
    assert summary.torque_ratio_max <= 0.85
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
        assert force.max() < 1.2 * r.run.mass * r.run.gravity
        assert pose[:, 2, 3].max() > 0.04
        assert pose[:, 2, 3].min() > -0.005
    names = r.run.joint_names
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
    assert (torque_ratios(r, r.run)[:, r.tau.any(axis=0)] <= 1.0 + 1e-12).all()
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
    r, sole = default_walk, Sole(*default_walk.run.sole)
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
    assert record.run.friction == 0.5
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
    assert summary.speed == pytest.approx(0.5 / 0.62, rel=0.03)
    # It ends where it was sent, not just where the last revision of the plan says.
    for foot in FEET:
        end = getattr(record, f"{foot}_foot")[-1]
        assert np.linalg.norm((end - record.plans[0].last_pose(foot))[:2, 3]) < 0.05


def test_another_solver_walks_the_same_way(talos: Robot, short_walk: Record) -> None:
    """DAQP is exact: torques and motion agree with what the persistent OSQP makes of them."""
    planner = pw.FootstepPlanner(0.25, talos.step_width, 0.8)
    walk = pw.Walk(talos, planner.generate_footsteps(5, ramp=1), solver="daqp")
    record = walk.run(until=3.0).record()
    n = len(record)
    assert np.abs(record.com - short_walk.com[:n]).max() < 1e-3
    assert np.sqrt(((record.tau - short_walk.tau[:n]) ** 2).mean()) < 0.5
