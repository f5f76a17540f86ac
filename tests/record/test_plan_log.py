"""The log of plans: every revision comes back, and arrays that do not fit are refused."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic_walk import walk_plan

from preview_walk.errors import InvalidInput
from preview_walk.record.plan_log import PLAN_ARRAYS, PlanLog
from preview_walk.record.record import Record
from preview_walk.record.recorder import Recorder
from preview_walk.record.run_facts import RunFacts

SIZES = {"nq": 10, "nv": 9, "nu": 3}


@pytest.fixture(scope="module")
def log() -> PlanLog:
    recorder = Recorder(RunFacts(control_hz=500), SIZES)
    plan = walk_plan(6)
    recorder.plan(0.0, plan)
    recorder.plan(2.0, plan.replace_after(plan.steps[1].land, []))
    return recorder.finish().plans


def test_every_revision_of_a_plan_comes_back(tmp_path: Path) -> None:
    plan = walk_plan(6)
    t1, t2 = plan.steps[1].land, plan.steps[2].land
    stopped = plan.replace_after(t1, [])
    longer = stopped.replace_after(t1, walk_plan(8).steps[len(stopped.steps) :])
    plans = [plan, stopped, longer, longer.since(t2)]
    times = [0.0, t1, t2, t2 + 0.01]
    recorder = Recorder(RunFacts(control_hz=500), SIZES)
    for time, each in zip(times, plans, strict=True):
        recorder.plan(time, each)
        recorder.plan(time + 1e-3, each)  # the same plan again is nothing new
    recorder.write(time=0.0)
    loaded = Record.load(recorder.finish().save(tmp_path / "x.npz"))
    assert len(loaded.plans) == 4
    for time, each, revision in zip(times, plans, loaded.plans, strict=True):
        assert revision.time == time
        assert revision.end == each.end
        np.testing.assert_array_equal(revision.land, [s.land for s in each])
        np.testing.assert_array_equal(revision.lift, [s.lift for s in each])
        np.testing.assert_array_equal(revision.pose, [s.pose for s in each])
        for foot in ("left", "right"):
            last = [s.pose for s in each if s.foot == foot][-1]
            np.testing.assert_array_equal(revision.last_pose(foot), last)
    assert [p.time for p in loaded.plans[1:3]] == times[1:3]
    with pytest.raises(IndexError):
        loaded.plans[4]


def test_walked_steps_survive_edits_and_forgetting() -> None:
    plan = walk_plan(8)
    recorder = Recorder(RunFacts(control_hz=500), SIZES)
    recorder.plan(0.0, plan)
    for step in plan.steps[2:6]:
        recorder.plan(step.land + 0.01, plan.since(step.land + 0.01))
    plans = recorder.finish().plans
    until = plan.steps[6].land
    np.testing.assert_array_equal(plans.walked(until).landings, [s.land for s in plan.steps[:7]])
    np.testing.assert_array_equal(plans.walked(-1.0).landings, [])
    np.testing.assert_array_equal(plans.walked(1e9).landings, [s.land for s in plan.steps])


def test_a_retargeted_step_counts_where_it_landed() -> None:
    plan = walk_plan(6)
    step = plan.steps[2]
    pose = step.pose.copy()
    pose[0, 3] += 0.05
    middle = 0.5 * (step.lift + step.land)
    recorder = Recorder(RunFacts(control_hz=500), SIZES)
    recorder.plan(0.0, plan)
    edited = plan.retarget(middle, pose, step.land + 0.05)
    recorder.plan(middle, edited)
    plans = recorder.finish().plans
    walked = plans.walked(1e9)
    np.testing.assert_array_equal(walked.landings, [s.land for s in edited.steps])
    np.testing.assert_array_equal(walked.pose[4], pose)
    assert plans.plan_kept[1] == 4  # two standing soles and two steps are shared


def test_log_and_revision_pickle_copy_and_stay_read_only(log: PlanLog) -> None:
    for twin in (pickle.loads(pickle.dumps(log)), copy.deepcopy(log), log):
        assert len(twin) == 2
        for name, array in twin.arrays().items():
            np.testing.assert_array_equal(array, getattr(log, name))
            assert not array.flags.writeable
        revision = copy.deepcopy(pickle.loads(pickle.dumps(twin[1])))
        for name in ("foot", "pose", "lift", "land"):
            with pytest.raises(ValueError, match="read-only"):
                getattr(revision, name)[0] = 0
            np.testing.assert_array_equal(getattr(revision, name), getattr(log[1], name))


def test_iterating_gives_the_same_revisions_as_indexing(log: PlanLog) -> None:
    for each, same in zip(log, (log[0], log[1]), strict=True):
        np.testing.assert_array_equal(each.land, same.land)


def test_repr_is_one_line(log: PlanLog) -> None:
    assert repr(log) == "PlanLog(2 revisions, 8 footsteps)"
    assert repr(log[1]) == f"PlanRevision(2 steps, 2.000 s to {log[1].end:.3f} s)"


@pytest.mark.parametrize("name", PLAN_ARRAYS)
def test_arrays_of_odd_lengths_are_refused(log: PlanLog, name: str) -> None:
    for wrong in (getattr(log, name)[:-1], getattr(log, name)[None], "text", None):
        with pytest.raises(InvalidInput):
            dataclasses.replace(log, **{name: wrong})


@pytest.mark.parametrize(
    ("wrong", "argument"),
    [
        ({"plan_kept": [0, 9]}, "plan_kept"),
        ({"plan_kept": [0, -1]}, "plan_kept"),
        ({"plan_kept": [2, 2]}, "plan_kept"),
        ({"plan_kept": [0, 0]}, "step_foot"),
        ({"step_revision": [0, 0, 0, 0, 0, 0, 0, 2]}, "step_revision"),
        ({"step_revision": [0, 0, 0, 0, 0, 0, 1, 0]}, "step_revision"),
        ({"step_revision": [-1, 0, 0, 0, 0, 0, 0, 0]}, "step_revision"),
        ({"step_revision": [1, 1, 1, 1, 1, 1, 1, 1]}, "step_foot"),
        ({"step_foot": [0, 0, 0, 1, 0, 1, 0, 1]}, "step_foot"),
        ({"step_foot": [0, 1, 0, 1, 0, 1, 0, 0.5]}, "step_foot"),
        ({"step_foot": [0, 1, 0, 1, 0, 1, 0, 2]}, "step_foot"),
    ],
)
def test_revisions_that_do_not_fit_together_are_refused(
    log: PlanLog, wrong: dict[str, Any], argument: str
) -> None:
    with pytest.raises(InvalidInput) as caught:
        dataclasses.replace(log, **wrong)
    assert caught.value.argument == argument
