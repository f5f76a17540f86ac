"""Diagnostics in words."""

import re
from dataclasses import replace

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.laying import lay_on
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.stride import Stride
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.pattern.check import check_plan, require_walkable
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.terrain.ground import FlatGround, Plane
from preview_walk.terrain.shapes import stairs

LIMITS = GaitLimits.for_leg(0.87, 0.2, Sole(0.1, 0.06))
PLANNER = FootstepPlanner(0.25, 0.2, 0.7)
PLAN = PLANNER.generate_footsteps(6, (5.0, 5.0, 2.0))
TIMES = np.arange(0.0, PLAN.end + 0.5, 0.005)
ZMP = zmp_reference(PLAN, LIMITS.sole).at(TIMES)
# A CoM that lags behind the ZMP like a low-pass filter: smooth, between the feet.
COM = np.array([ZMP[max(0, k - 60) : k + 61].mean(axis=0) for k in range(len(ZMP))])


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def texts(*args, **kwargs):
    return [f.text for f in check_plan(*args, **kwargs)]


def test_a_good_walk_has_nothing_wrong():
    assert check_plan(PLAN, LIMITS) == ()
    assert check_plan(PLAN, LIMITS, TIMES, ZMP, COM) == ()
    assert check_plan(PLAN, LIMITS, TIMES, com=np.column_stack([COM, 0 * TIMES])) == ()
    fast = FootstepPlanner(0.5, 0.2, 0.62, 0.05).generate_footsteps(12, ramp=3)
    for dt in (0.001, 0.005):
        t = np.arange(0.0, fast.end, dt)
        assert check_plan(fast, LIMITS, t, zmp_reference(fast, LIMITS.sole).at(t)) == ()
    require_walkable(PLAN, LIMITS)


def test_a_step_out_of_reach():
    plan = PLANNER.walk([Stride(0.2), Stride(0.8), Stride()])
    (finding,) = check_plan(plan, LIMITS)
    assert finding.step == 2
    assert finding.time == plan.steps[1].land
    assert str(finding) == (
        "at 2.860 s step 2 lands 0.800 m ahead of the left sole, at most 0.652 m is allowed"
    )
    assert finding.argument == "step_length"
    with raises(f"the plan cannot be walked: {finding}."):
        require_walkable(plan, LIMITS)


@pytest.mark.parametrize(
    ("plan", "argument"),
    [
        (PLANNER.walk([Stride(0.8), Stride()]), "step_length"),
        (PLANNER.walk([Stride(0.2, time=0.2), Stride()]), "step_time"),
        (PLANNER.walk([Stride(width=0.9), Stride()]), "step_width"),
        (PLANNER.generate_footsteps(4, turn=0.6), "turn"),
        (PLANNER.generate_footsteps(4, turn=-0.3), "turn"),
    ],
)
def test_the_argument_of_a_planner_is_named(plan, argument):
    assert check_plan(plan, LIMITS)[0].argument == argument
    with pytest.raises(InvalidInput) as caught:
        require_walkable(plan, LIMITS)
    assert caught.value.argument == argument


def test_the_reference_that_is_wrong_is_named():
    away = ZMP + np.where(TIMES[:, None] > 3.0, 0.5, 0.0)
    assert {f.argument for f in check_plan(PLAN, LIMITS, TIMES, away)} == {"zmp"}
    assert {f.argument for f in check_plan(PLAN, LIMITS, TIMES, com=away)} == {"com"}


def test_a_step_too_quick():
    plan = PLANNER.walk([Stride(0.2, time=0.2), Stride()])
    assert texts(plan, LIMITS) == ["step 1 is 0.160 s in the air, at least 0.253 s is needed"]


def test_feet_that_collide_at_landing_or_on_the_way():
    plan = PLANNER.walk([Stride(width=0.05), Stride()])
    assert texts(plan, LIMITS)[0].startswith("step 1 lands 0.125 m beside the right sole, at least")
    # Round the front of the standing foot: from behind on the left to ahead on the left, but the
    # stance sole stands between.
    steps = list(PLAN)
    blocked = replace(steps[3], pose=steps[3].pose @ pose_at(0.0, 0.2))
    plan = PLAN.replace_after(0.0, [steps[2], blocked, *steps[4:]])
    assert any("step 3 swings across the right sole" in text for text in texts(plan, LIMITS))


def test_a_zmp_outside_the_support():
    away = ZMP.copy()
    k = int(np.searchsorted(TIMES, PLAN.steps[2].lift + 0.2))
    across = np.array([-np.sin(2.0), np.cos(2.0)])
    away += np.exp(-(((TIMES - TIMES[k]) / 0.03) ** 2))[:, None] * 0.1 * across
    (finding,) = check_plan(PLAN, LIMITS, TIMES, away)
    assert finding.text == "the ZMP is 0.040 m outside the support polygon (right support)"
    assert finding.time == pytest.approx(TIMES[k])


def test_a_zmp_that_jumps():
    hard = np.array([ZMP[min(len(ZMP) - 1, k)] for k in range(len(ZMP))])
    for s in PLAN.steps:
        middle = s.land + 0.07
        near = np.abs(TIMES - middle) <= 0.08
        before, after = (
            ZMP[np.searchsorted(TIMES, s.land)],
            ZMP[min(len(ZMP) - 1, np.searchsorted(TIMES, s.land + 0.14))],
        )
        if s is not PLAN.steps[-1]:
            hard[near] = np.where((TIMES[near] < middle)[:, None], before, after)
    found = check_plan(PLAN, LIMITS, TIMES, hard)
    assert len(found) == 5
    jump = np.hypot(0.25, 0.2)
    assert found[0].text == f"the ZMP jumps by {jump:.3f} m in 0.0050 s"
    assert found[0].time == pytest.approx(PLAN.steps[0].land + 0.07, abs=0.006)


def test_a_com_that_runs_away():
    away = COM + 0.001 * np.exp(2.0 * (TIMES - 3.0))[:, None]
    found = [f for f in check_plan(PLAN, LIMITS, TIMES, com=away) if "diverges" in f.text]
    assert len(found) == 1
    assert re.fullmatch(r"the CoM diverges: it is 0\.10\d m outside the feet", found[0].text)
    assert 4.0 < found[0].time < 6.0


def test_a_com_that_jumps():
    away = COM + np.where(TIMES > 3.0, 0.01, 0.0)[:, None]
    found = check_plan(PLAN, LIMITS, TIMES, com=away)
    assert [f.text.split(":")[0] for f in found] == ["the CoM jumps"]
    assert found[0].time == pytest.approx(3.0, abs=0.006)


@pytest.mark.parametrize(("name", "label"), [("zmp", "ZMP"), ("com", "CoM")])
def test_a_reference_that_is_no_number(name, label):
    path = (ZMP if name == "zmp" else COM).copy()
    path[300:, 0] = np.nan
    (finding,) = check_plan(PLAN, LIMITS, TIMES, **{name: path})
    assert str(finding) == f"at 1.500 s the {label} is not finite"


def test_several_findings_are_counted():
    plan = PLANNER.walk([Stride(0.8), Stride(0.8), Stride()])
    with pytest.raises(InvalidInput, match=r"is allowed \(1 more\)\.$"):
        require_walkable(plan, LIMITS)


def test_references_need_times_and_shapes():
    with raises("times (N,) must be given with zmp or com, got None."):
        check_plan(PLAN, LIMITS, zmp=ZMP)
    with raises("times must be finite and increase."):
        check_plan(PLAN, LIMITS, [0.0, 0.0])
    with raises("times must have shape (N,), got ()."):
        check_plan(PLAN, LIMITS, 1.0)
    with raises(f"zmp must have shape ({len(TIMES)}, 2), got (3, 2)."):
        check_plan(PLAN, LIMITS, TIMES, ZMP[:3])
    with raises("com must have shape (1, 2) or (1, 3), got (1, 4)."):
        check_plan(PLAN, LIMITS, [0.0], com=np.zeros((1, 4)))


def test_soles_that_do_not_lie_on_the_ground():
    """Above, below, tilted, across an edge, each in its words; a laid plan has none of them."""
    planner = FootstepPlanner(0.3, 0.2, 1.0)
    plan = planner.generate_footsteps(4)
    assert texts(plan, LIMITS, ground=FlatGround()) == []
    assert texts(plan, LIMITS, ground=FlatGround(0.05))[0] == (
        "the left sole at the start is 0.050 m below the ground"
    )
    down = stairs(-0.1, 2.0, 1, begin=0.62)
    assert texts(plan, LIMITS, ground=down)[:2] == [
        "step 2 stands across an edge of the ground, 0.100 m deep",
        "step 3 is 0.100 m above the ground",
    ]
    tilted = Plane(0.0, np.tan(np.radians(9.0)))
    first = texts(plan, LIMITS, ground=tilted)[0]
    assert "the left sole at the start is tilted by 0.157 rad" in first
    for ground in (down, tilted, FlatGround(0.05)):
        assert texts(lay_on(plan, ground, LIMITS), LIMITS, ground=ground) == []
