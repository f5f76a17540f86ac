"""The swing foot: at rest at both ends, clear of the ground, retargeted without a jump."""

import re

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at
from preview_walk.lab.swing import SwingLegTrajectory
from preview_walk.pattern.swing import Swing, swing_of

near = st.floats(-0.6, 0.6)
height = st.floats(-0.2, 0.2)
tilt = st.floats(-0.4, 0.4)
poses = st.builds(pose_at, near, near, st.floats(-3.1, 3.1), height, tilt, tilt)
swings = st.builds(
    Swing,
    poses,
    poses,
    st.just(2.0),
    st.floats(2.25, 3.5),
    st.floats(0.0, 0.1),
    st.floats(0.0, 0.05),
)


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def path(swing, n=201):
    times = np.linspace(swing.lift, swing.land, n)
    return times, *(np.array(x) for x in zip(*(swing.at(t) for t in times.tolist()), strict=True))


@given(swings)
def test_at_rest_at_both_ends(swing):
    for t, expected in (
        (swing.lift, swing.start),
        (swing.land, swing.end),
        (swing.lift - 1.0, swing.start),
        (swing.land + 1.0, swing.end),
    ):
        pose, velocity, acceleration = swing.at(t)
        assert np.allclose(pose, expected, atol=1e-9)
        assert np.allclose(velocity, 0.0, atol=1e-9)
        assert np.allclose(acceleration, 0.0, atol=1e-7)


@settings(max_examples=50)
@given(swings)
def test_velocity_and_acceleration_are_the_derivatives(swing):
    times, poses_, velocities, accelerations = path(swing)
    h = 1e-5
    for k in range(10, 190, 12):
        t = float(times[k])
        (before, v0, _), (after, v1, _) = swing.at(t - h), swing.at(t + h)
        assert np.allclose((after[:3, 3] - before[:3, 3]) / (2 * h), velocities[k, :3], atol=1e-5)
        spin = (after[:3, :3] - before[:3, :3]) / (2 * h) @ poses_[k, :3, :3].T
        omega = [spin[2, 1], spin[0, 2], spin[1, 0]]
        assert np.allclose(omega, velocities[k, 3:], atol=1e-4)
        assert np.allclose((v1 - v0) / (2 * h), accelerations[k], atol=1e-3 * swing_scale(swing))


def swing_scale(swing):
    return 1.0 + 100.0 / (swing.land - swing.lift) ** 3 * 1e-2


@given(swings)
def test_clears_the_heights_it_was_given(swing):
    _, poses_, _, _ = path(swing)
    position = poses_[:, :3, 3]
    top = max(swing.start[2, 3], swing.end[2, 3])
    assert position[:, 2].max() >= top + swing.swing_height - 1e-12
    travel = swing.end[:3, 3] - swing.start[:3, 3]
    assume(np.hypot(*travel[:2]) > 1e-3)
    share = (position - swing.start[:3, 3])[:, :2] @ travel[:2] / (travel[:2] @ travel[:2])
    middle = (share >= 0.1) & (share <= 0.9)
    line = swing.start[2, 3] + share * travel[2]
    assert (position[:, 2] - line)[middle].min() >= swing.ground_clearance - 1e-9


@given(swings)
def test_touches_down_softly(swing):
    duration = swing.land - swing.lift
    _, velocity, _ = swing.at(swing.land - 0.02 * duration)
    drop = max(swing.start[2, 3], swing.end[2, 3]) + 0.11 - swing.end[2, 3]
    assert abs(velocity[2]) < 0.1 * drop / duration


@given(swings)
def test_does_not_care_where_the_world_begins(swing):
    by = pose_at(30.0, -20.0, 2.5, 1.0)
    moved = Swing(
        by @ swing.start,
        by @ swing.end,
        swing.lift,
        swing.land,
        swing.swing_height,
        swing.ground_clearance,
    )
    turn = np.kron(np.eye(2), by[:3, :3])
    for t in np.linspace(swing.lift, swing.land, 7).tolist():
        for a, b, m in zip(swing.at(t), moved.at(t), (by, turn, turn), strict=True):
            assert np.allclose(m @ a, b, atol=1e-8)


times_and_goals = st.tuples(st.floats(0.0, 0.98), poses, st.floats(-0.4, 0.6))


def retargeted(swing, share, pose, change):
    t = swing.lift + share * (swing.land - swing.lift)
    land = max(swing.land + change * (swing.land - t), t + 0.02)
    return t, land, swing.retarget(t, pose, land)


@given(swings, st.lists(times_and_goals, min_size=1, max_size=3))
def test_a_new_landing_makes_no_jump(swing, changes):
    for share, pose, change in sorted(changes, key=lambda c: c[0]):
        t, land, new = retargeted(swing, share, pose, change)
        for old, now, size in zip(swing.at(t), new.at(t), (1.0, 1.0, 1e3), strict=True):
            assert np.allclose(old, now, atol=1e-8 * size)
        end, velocity, acceleration = new.at(land)
        assert np.allclose(end, pose, atol=1e-8)
        assert np.allclose(velocity, 0.0, atol=1e-6)
        # The end state of a quintic over 20 ms: rounding of 1e-12 m, divided by T^2.
        assert np.allclose(acceleration, 0.0, atol=1e-4)
        for piece in new.vertical[:-1]:
            before, after = new.at(piece.end - 1e-9), new.at(piece.end + 1e-9)
            assert np.allclose(before[1], after[1], atol=1e-4)
            assert np.allclose(before[2], after[2], atol=1.0)
        swing = new


@given(swings, st.floats(0.0, 0.95))
def test_the_same_landing_again_changes_nothing(swing, share):
    t = swing.lift + share * (swing.land - swing.lift)
    new = swing.retarget(t, swing.end)
    for later in np.linspace(t, swing.land, 7).tolist():
        for old, now in zip(swing.at(later), new.at(later), strict=True):
            assert np.allclose(old, now, atol=1e-6)


def retarget_every_tick(swing, goal_of, dt=0.005):
    t, heights = swing.lift, []
    while t < swing.land - dt:
        t += dt
        goal, land = goal_of(t)
        swing = swing.retarget(t, goal, land) if t < swing.land else swing
        heights.append(swing.at(t)[0][2, 3])
    return swing, heights


def test_a_goal_that_moves_at_every_tick_is_reached():
    swing = Swing(pose_at(0.0, 0.0), pose_at(0.5, 0.0), 0.0, 0.6)
    end, heights = retarget_every_tick(
        swing, lambda t: (pose_at(0.5 + 0.1 * min(t, 0.5), 0.05, 0.2 * min(t, 0.5)), 0.6)
    )
    assert end.at(0.6)[0][0, 3] == pytest.approx(0.55)
    assert max(heights) == pytest.approx(0.05, abs=1e-3)
    assert min(heights) > -1e-3


def test_a_foot_nearly_down_rises_again_on_its_way_to_another_sole():
    swing = Swing(pose_at(0.0, 0.0), pose_at(0.5, 0.0), 0.0, 0.6)
    new = swing.retarget(0.55, pose_at(0.5, -0.2), 0.75)
    times = np.linspace(0.55, 0.75, 50).tolist()
    z = np.array([new.at(t)[0][2, 3] for t in times])
    assert z.max() == pytest.approx(swing.ground_clearance, abs=1e-3)
    assert z.min() > -1e-3
    halfway = new.retarget(0.6, pose_at(0.5, -0.22), 0.75)
    assert max(halfway.at(t)[0][2, 3] for t in times[10:]) < 1.1 * swing.ground_clearance
    assert halfway.at(0.75)[0][1, 3] == pytest.approx(-0.22)


@given(st.floats(0.05, 0.95), st.floats(0.02, 1.0), st.floats(-0.05, 0.05))
def test_a_delayed_foot_does_not_dip_into_the_ground(share, delay, rise):
    swing = Swing(pose_at(0.0, 0.0), pose_at(0.5, 0.0), 0.0, 0.6)
    t = 0.6 * share
    new = swing.retarget(t, pose_at(0.5, 0.0, 0.0, rise), 0.6 + delay)
    z = np.array([new.at(s)[0][2, 3] for s in np.linspace(t, new.land, 200).tolist()])
    assert z.min() > min(swing.at(t)[0][2, 3], rise) - 2e-3


@given(st.floats(0.05, 0.95), st.floats(0.02, 1.0))
def test_a_delayed_foot_does_not_overshoot(share, delay):
    swing = Swing(pose_at(0.0, 0.0), pose_at(0.5, 0.0), 0.0, 0.6)
    new = swing.retarget(0.6 * share, swing.end, 0.6 + delay)
    x = np.array([new.at(s)[0][0, 3] for s in np.linspace(0.6 * share, new.land, 200).tolist()])
    assert x.max() < 0.5 + 5e-3


def test_turns_the_short_way():
    swing = Swing(pose_at(0.0, 0.0, 3.0), pose_at(0.3, 0.0, -3.0), 0.0, 1.0)
    _, velocity, _ = swing.at(0.5)
    assert velocity[5] == pytest.approx((2 * np.pi - 6.0) * 1.875)


def test_the_swing_of_a_step_lasts_its_single_support():
    planner = FootstepPlanner(0.3, 0.2, 0.7)
    plan = planner.generate_footsteps(5)
    swing = swing_of(plan, plan.steps[2], 0.07)
    assert (swing.lift, swing.land) == (plan.steps[2].lift, plan.steps[2].land)
    assert swing.land - swing.lift == pytest.approx(planner.single_support_time)
    assert np.array_equal(swing.start, plan.steps[0].pose)
    assert swing.at(0.5 * (swing.lift + swing.land))[0][2, 3] == pytest.approx(0.07)


def test_the_lab_call():
    t, pos, vel = SwingLegTrajectory().generate_trajectory((0, 0, 0), (0.3, 0.1, 0.0), 0.4, 0.01)
    assert t.shape == (41,)
    assert pos.shape == vel.shape == (41, 3)
    assert np.allclose(pos[[0, -1]], [[0, 0, 0], [0.3, 0.1, 0.0]])
    assert np.allclose(vel[[0, -1]], 0.0)
    assert pos[:, 2].max() == pytest.approx(0.05)
    assert np.allclose(np.gradient(pos, t, axis=0)[2:-2], vel[2:-2], atol=0.02)


SWING = Swing(np.eye(4), pose_at(0.3, 0.0), 1.0, 2.0)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: Swing(np.eye(4), np.eye(4), 1.0, 1.0),
            "a swing needs lift < land, got 1.0 s, 1.0 s.",
        ),
        (
            lambda: Swing(np.eye(4), np.eye(4), 0.0, 1.0, -0.1),
            "swing_height must be >= 0 m, got -0.1.",
        ),
        (
            lambda: Swing(np.eye(4), np.eye(4), 0.0, 1.0, 0.1, np.nan),
            "ground_clearance must be >= 0 m, got nan.",
        ),
        (
            lambda: SWING.retarget(2.0, np.eye(4)),
            "t must be within the swing, 1.000 s to 2.000 s, got 2.0.",
        ),
        (
            lambda: SWING.retarget(1.5, np.eye(4), 1.5),
            "land must be after t = 1.500 s, got 1.5 s.",
        ),
        (
            lambda: SwingLegTrajectory().generate_trajectory((0, 0), (0, 0, 0), 1.0, 0.1),
            "start_pos must be (x, y, z) in m, got (0, 0).",
        ),
        (
            lambda: SwingLegTrajectory().generate_trajectory((0, 0, 0), (0, 0, 0), 0.0, 0.1),
            "duration must be > 0 s, got 0.0.",
        ),
    ],
)
def test_what_cannot_be_is_refused(make, sentence):
    with raises(sentence):
        make()
