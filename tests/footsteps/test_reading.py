"""Plans read from what others write."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.reading import as_plan
from preview_walk.footsteps.stride import Stride
from preview_walk.geometry.poses import pose_at
from preview_walk.lab.zmp import ZMPTrajectoryGenerator
from preview_walk.record.plan_writer import PlanWriter

KEYS = ("foot", "pos", "time", "type")
PLANNER = FootstepPlanner(0.2, 0.2, 0.7)
PLAN = PLANNER.generate_footsteps(6, (1.0, 2.0, 0.5), turn=0.1)


def dictionaries(plan, *more):
    return [{**{k: s[k] for k in KEYS}, **{name: getattr(s, name) for name in more}} for s in plan]


def same(a, b, *names):
    assert len(a) == len(b)
    for x, y in zip(a, b, strict=True):
        assert (x.foot, x.land, x.type) == (y.foot, y.land, y.type)
        for name in names:
            assert np.allclose(getattr(x, name), getattr(y, name), rtol=0.0, atol=1e-12)


def test_a_plan_is_itself_and_its_footsteps_are_read():
    assert as_plan(PLAN) is PLAN
    assert list(as_plan(list(PLAN))) == list(PLAN)
    assert list(as_plan(tuple(PLAN))) == list(PLAN)


@given(st.integers(0, 12), st.floats(0.1, 0.4), st.floats(0.4, 1.5), st.floats(-3.0, 3.0))
def test_the_labs_dictionaries_bring_back_feet_places_and_landings(n, length, time, yaw):
    plan = FootstepPlanner(length, 0.2, time).generate_footsteps(n, (1.0, 2.0, yaw))
    same(as_plan(dictionaries(plan)), plan, "pos")
    same(as_plan([dict(step) for step in plan]), plan, "pos")


def test_yaw_and_lift_may_be_given():
    same(as_plan(dictionaries(PLAN, "yaw", "lift")), PLAN, "pose", "lift")
    flat = [{**step, "pos": step["pos"][:2].tolist()} for step in dictionaries(PLAN)]
    same(as_plan(flat), PLAN, "pos")


def test_without_a_lift_a_share_of_the_time_is_double_support():
    given = dictionaries(PLAN)
    for ratio in (None, 0.4):
        plan = as_plan(given) if ratio is None else as_plan(given, ratio)
        before = [plan.start, *(s.land for s in plan.steps)]
        for landed, step in zip(before, plan.steps, strict=False):
            assert step.lift - landed == pytest.approx((ratio or 0.2) * (step.land - landed))


def test_a_walk_of_equal_steps_lifts_as_it_did():
    # All steps but the first, before which the robot stands for a while.
    read = as_plan(dictionaries(PLAN))
    assert [s.lift for s in read.steps[1:]] == pytest.approx([s.lift for s in PLAN.steps[1:]])


def test_the_plan_of_a_record():
    writer = PlanWriter()
    plan = FootstepPlan([*PLAN], weight_shift=0.3)
    writer.write(0.0, plan)
    again = replace(plan.steps[-1], lift=plan[-1].land + 0.1, land=plan[-1].land + 0.5, again=True)
    pushed = plan.replace_after(plan[-1].lift, [again])
    writer.write(1.0, pushed)
    for revision, wanted in zip(writer.finish(), (plan, pushed), strict=True):
        read = as_plan(revision)
        same(read, wanted, "pose", "lift")
        assert [s.again for s in read] == [s.again for s in wanted]
        assert (read.weight_shift, read.end) == (0.3, wanted.end)
    standing = PLANNER.stand((1.0, 0.0, 0.3))
    writer = PlanWriter()
    writer.write(0.0, standing)
    same(as_plan(writer.finish()[0]), standing, "pose", "lift")


ROWS = {
    "foot": np.array([0, 1]),
    "pose": np.array([pose_at(0.0, 0.1), pose_at(0.0, -0.1)]),
    "lift": np.zeros(2),
    "land": np.zeros(2),
}


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        (None, r"plan must be a FootstepPlan, .* got None\."),
        ("walk", r"plan must be .* got 'walk'\."),
        (3.0, r"plan must be .* got 3\.0\."),
        ({"foot": "left"}, r"plan must be .* got \{'foot': 'left'\}\."),
        (PLAN[0], r"plan must be .*\."),
        (np.zeros((3, 2)), r"plan must be .* got an array of shape \(3, 2\)\."),
        ([], r"plan is none: a plan must begin with one left and one right .* got nothing\."),
        ([1, 2], r"plan is none: entry 0 must be a Footstep or a dictionary, got 1\."),
        ([{"foot": "left"}], r"plan is none: entry 0 must have the key 'pos', got .*\."),
        (
            [{**dictionaries(PLAN)[0], "pos": "here"}],
            r"plan is none: pos of entry 0 must be \(x, y\) or \(x, y, z\) in m, got 'here'\.",
        ),
        (
            [{**dictionaries(PLAN)[0], "pos": (1.0,)}],
            r"plan is none: pos of entry 0 must be \(x, y\) or \(x, y, z\) in m, got \(1\.0,\)\.",
        ),
        (
            [{**dictionaries(PLAN)[0], "time": "now"}],
            r"plan is none: time of entry 0 must be finite \(s\), got 'now'\.",
        ),
        (
            [{**dictionaries(PLAN)[0], "type": "jump"}],
            r"plan is none: type must be 'stance' or 'swing_end', got 'jump'\.",
        ),
        (SimpleNamespace(**{**ROWS, "foot": np.array([0, 2])}), r"plan is none: its rows must .*"),
        (SimpleNamespace(**{**ROWS, "land": 0.0}), r"plan is none: its rows must .*"),
        (SimpleNamespace(**{**ROWS, "pose": None}), r"plan is none: pose must be an array .*"),
    ],
)
def test_anything_else_is_refused_in_one_sentence(value, sentence):
    with pytest.raises(InvalidInput) as caught:
        as_plan(value)
    assert re.fullmatch(sentence, str(caught.value))
    assert caught.value.argument == "plan"


def test_the_labs_classes_take_what_is_read():
    generator = ZMPTrajectoryGenerator(PLANNER)
    t, zmp = generator.generate_zmp_trajectory(dictionaries(PLAN, "yaw", "lift"))
    wanted = generator.generate_zmp_trajectory(PLAN)
    assert np.array_equal(t, wanted[0])
    assert np.allclose(zmp, wanted[1], rtol=0.0, atol=1e-12)
    for now in (0.0, 1.7, 2.1, 9.0):
        phase = PLANNER.get_support_phase(now, dictionaries(PLAN, "yaw", "lift"))
        assert phase == PLANNER.get_support_phase(now, PLAN)


def test_a_footstep_answers_as_a_dictionary_does():
    step = PLAN.steps[0]
    assert list(step) == list(step.keys()) == list(KEYS)
    assert all(key in step for key in KEYS)
    assert "lift" not in step
    assert 3 not in step
    assert step.get("foot") == step["foot"] == "left"
    assert step.get("colour") is None
    assert step.get("colour", "red") == "red"
    x, y = step["pos"]
    assert [x, y] == step.get("pos").tolist() == step.pos[:2].tolist()
    assert dict(step.items()).keys() == dict(step).keys() == set(KEYS)
    assert step.values()[::2] == (step.foot, step.land)
    with pytest.raises(KeyError, match="foot, pos, time, type"):
        step["colour"]
    assert isinstance(step, Footstep)


def test_a_stand_between_two_walks_is_read_too():
    both = PLANNER.walk([Stride(0.2), Stride()], PLAN)
    same(as_plan(dictionaries(both)), both, "pos")
