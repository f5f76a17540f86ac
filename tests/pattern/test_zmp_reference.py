"""The ZMP reference: smooth, and inside the support polygon at every instant."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.stride import Stride
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole, support_margin, support_polygon
from preview_walk.lab.zmp import ZMPTrajectoryGenerator
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import FEET

SOLE = Sole(0.1, 0.06)


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def tilted(plan, rng):
    """The same plan on uneven ground: every sole at its own height and slope."""
    steps = []
    for s in plan:
        z, pitch, roll = rng.uniform(-1.0, 1.0, 3) * (0.15, 0.3, 0.3)
        steps.append(replace(s, pose=s.pose @ pose_at(0.0, 0.0, 0.0, z, pitch, roll)))
    return FootstepPlan(steps, plan.weight_shift)


@st.composite
def plans(draw):
    strides = draw(
        st.lists(
            st.builds(
                Stride,
                forward=st.floats(-0.3, 0.6),
                left=st.floats(-0.05, 0.05),
                turn=st.floats(-0.4, 0.4),
                width=st.floats(0.15, 0.3),
                time=st.sampled_from([0.3, 0.5, 0.7, 1.0, 3.0]),
                double_support_ratio=st.sampled_from([0.001, 0.02, 0.05, 0.1, 0.2, 0.5]),
            ),
            min_size=1,
            max_size=6,
        )
    )
    plan = FootstepPlanner(0.2, 0.2, 0.7).walk(strides, (3.0, -2.0, 1.0))
    rng = np.random.default_rng(draw(st.integers(0, 9)))
    return tilted(plan, rng) if draw(st.booleans()) else plan


def margins(plan, times, zmp):
    """Signed distance of the ZMP to the edge of the support polygon, a polygon for each phase."""
    phase = np.array([-1 if (s := plan.swing_at(t)) is None else id(s) for t in times.tolist()])
    landed = np.searchsorted([s.land for s in plan.steps], times, side="right")
    cuts = np.flatnonzero(np.diff(phase) | np.diff(landed)) + 1
    result = []
    for span in np.split(np.arange(len(times)), cuts):
        swing = plan.swing_at(float(times[span[0]]))
        feet = [f for f in FEET if swing is None or swing.foot != f]
        polygon = support_polygon([plan.sole(f, float(times[span[0]])) for f in feet], SOLE)
        result.append(support_margin(polygon, zmp[span]))
    return np.concatenate(result)


@settings(max_examples=60)
@given(plans(), st.sampled_from([0.0, 0.02, 0.05]))
def test_inside_the_true_support_polygon_at_every_instant(plan, margin):
    edges = np.array([e for s in plan.steps for e in (s.lift, s.land)])
    around = np.concatenate([edges + d for d in (-0.02, -1e-6, 0.0, 1e-6, 0.02)])
    t = np.sort(np.concatenate([around, np.linspace(-0.5, plan.end + 0.5, 150)]))
    assert margins(plan, t, zmp_reference(plan, SOLE, margin).at(t)).min() > -1e-9


@settings(max_examples=60)
@given(plans())
def test_continuous_with_its_velocity(plan):
    ref = zmp_reference(plan, SOLE)
    knots = ref.times
    before = np.nextafter(knots, -np.inf)
    assert np.allclose(ref.at(before), ref.at(knots), atol=1e-9)
    assert np.allclose(ref.velocity(before), ref.velocity(knots), atol=1e-6)
    t = np.linspace(-0.3, plan.end + 0.3, 1001)
    v = ref.velocity(t)
    middle = 0.5 * (t[1:] + t[:-1])
    step = t[1] - t[0]
    mean = (v[1:] + 4.0 * ref.velocity(middle) + v[:-1]) / 6.0
    smooth = np.searchsorted(knots, t[1:]) == np.searchsorted(knots, t[:-1])
    assert np.allclose(np.diff(ref.at(t), axis=0)[smooth], (mean * step)[smooth], atol=1e-9)


@given(st.tuples(st.floats(-100, 100), st.floats(-100, 100), st.floats(-3.1, 3.1)))
def test_moves_with_the_plan(where):
    plan = FootstepPlanner(0.4, 0.2, 0.6, 0.06).generate_footsteps(8, turn=0.1, ramp=2)
    by = pose_at(*where)
    t = np.linspace(0.0, plan.end, 200)
    here = zmp_reference(plan, SOLE).at(t)
    there = zmp_reference(plan.transformed(by), SOLE).at(t)
    assert np.allclose(here @ by[:2, :2].T + by[:2, 3], there, atol=1e-9)


def test_rests_at_midfeet_at_both_ends_and_at_the_sole_in_between():
    plan = FootstepPlanner(0.25, 0.2, 0.7, 0.2).generate_footsteps(5)
    ref = zmp_reference(plan)
    assert ref.at(-1.0) == pytest.approx([0.0, 0.0])
    assert ref.at(plan.end) == pytest.approx([1.0, 0.0])
    assert ref.at(1e4) == pytest.approx([1.0, 0.0])
    for s in plan.steps:
        stance = plan.sole("left" if s.foot == "right" else "right", s.lift)[:2, 3]
        for t in np.linspace(s.lift, s.land, 9):
            assert ref.at(t) == pytest.approx(stance, abs=1e-12)
            assert ref.velocity(t) == pytest.approx([0.0, 0.0], abs=1e-9)


def test_crosses_by_the_cubic():
    plan = FootstepPlanner(0.25, 0.2, 0.7, 0.2).generate_footsteps(5)
    a, b = plan.steps[1].land, plan.steps[2].lift
    start, end = zmp_reference(plan).at([a, b])
    for u in (0.1, 0.5, 0.8):
        expected = start + (3 * u**2 - 2 * u**3) * (end - start)
        assert zmp_reference(plan).at(a + u * (b - a)) == pytest.approx(expected)


def test_a_very_short_double_support_is_crossed_from_sole_to_sole():
    plan = FootstepPlanner(0.5, 0.17, 0.62, 0.05).generate_footsteps(8)
    s = plan.steps[3]
    ref = zmp_reference(plan, SOLE, 0.02)
    stance = plan.steps[2].pos[:2]
    # At landing the ZMP is at the tip of the standing sole, 2 cm from its edge.
    assert ref.at(s.land)[0] - stance[0] == pytest.approx(0.08)
    assert ref.at(s.land - 0.05) == pytest.approx(stance, abs=1e-12)
    # It goes half as fast as a cubic over the double support alone would.
    speed = np.linalg.norm(ref.velocity(np.linspace(s.land, plan.steps[4].lift, 99)), axis=1)
    assert speed.max() < 0.55 * 1.5 * np.hypot(0.5, 0.17) / 0.031


def test_a_stand_is_rested_at_midfeet():
    planner = FootstepPlanner(0.2, 0.2, 0.7)
    plan = planner.walk([Stride(0.2), Stride()], planner.generate_footsteps(4))
    pause = plan.steps[3].land, plan.steps[4].lift
    ref = zmp_reference(plan)
    rest = np.linspace(pause[0] + plan.weight_shift, pause[1] - plan.weight_shift, 5)
    assert np.allclose(ref.at(rest), [[0.6, 0.0]] * 5)
    assert np.allclose(ref.velocity(rest), 0.0)
    # There and back it takes the whole shift of weight: halfway in time is halfway in space.
    shift = 0.5 * plan.weight_shift
    for t, stood in ((pause[0] + shift, "left"), (pause[1] - shift, "right")):
        sole = plan.sole(stood, t)[:2, 3]
        assert np.allclose(ref.at(t), 0.5 * (sole + np.array((0.6, 0.0))))


def test_replacing_the_future_keeps_the_past():
    plan = FootstepPlanner(0.3, 0.2, 0.6, 0.05).generate_footsteps(9)
    t = plan.steps[4].lift + 0.01
    shorter = plan.replace_after(t, [])
    past = np.linspace(0.0, t, 300)
    assert np.array_equal(zmp_reference(plan).at(past), zmp_reference(shorter).at(past))


def test_standing_is_a_constant():
    plan = FootstepPlanner().generate_footsteps(0, (1.0, 2.0))
    ref = zmp_reference(plan)
    assert np.allclose(ref.at([-5.0, 0.0, 5.0]), [[1.0, 2.0]] * 3)
    assert np.allclose(ref.velocity([-5.0, 0.0, 5.0]), 0.0)


def test_shapes():
    ref = zmp_reference(FootstepPlanner().generate_footsteps(4))
    assert ref.at(1.0).shape == ref.velocity(1.0).shape == (2,)
    assert ref.at(np.ones(7)).shape == ref.velocity(np.ones(7)).shape == (7, 2)
    assert np.array_equal(ref.at([1.0, 2.0])[1], ref.at(2.0))


def test_the_lab_call_samples_the_whole_plan():
    planner = FootstepPlanner()
    plan = planner.generate_footsteps(6)
    t, zmp = ZMPTrajectoryGenerator(planner).generate_zmp_trajectory(plan, 0.01)
    assert t[0] == plan.start
    assert t[-1] == pytest.approx(plan.end, abs=0.01)
    assert zmp.shape == (len(t), 2)
    assert np.array_equal(zmp, zmp_reference(plan).at(t))
    again = ZMPTrajectoryGenerator(planner).generate_zmp_trajectory(list(plan), 0.01)
    assert np.array_equal(again[1], zmp)


def test_bad_input():
    planner = FootstepPlanner()
    plan = planner.generate_footsteps(2)
    with raises("dt must be > 0 s, got 0.0."):
        ZMPTrajectoryGenerator(planner).generate_zmp_trajectory(plan, 0.0)
    with raises("margin must be >= 0 m, got -0.01."):
        zmp_reference(plan, margin=-0.01)
