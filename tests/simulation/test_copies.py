"""Copies of a walk, pickled or deep, go on bit for bit as the original does."""

from __future__ import annotations

import copy
import pickle
from dataclasses import dataclass

import joblib
import pytest

import preview_walk as pw
from preview_walk.robots.robot import Robot


def busy_walk(robot: Robot) -> pw.Walk:
    """Return a walk in the middle of a push and of a swing, by command."""
    walk = pw.Walk.standing(robot, pushes=[pw.Push(3.0, 0.2, (250.0, 80.0, 0.0))])
    walk.command(0.6, 0.0, 0.1)
    return walk.run(until=3.11)


@dataclass
class Copied:
    """A walk that has gone on since, and copies of what it was."""

    record: pw.Record
    pickled: bytes
    deep: pw.Walk


@pytest.fixture(scope="module")
def copied(talos: Robot) -> Copied:
    walk = busy_walk(talos)
    pickled, deep = pickle.dumps(walk), copy.deepcopy(walk)
    assert deep.plant is not walk.plant
    record = walk.run(until=4.2).record()
    assert len(record.plans) > 3
    return Copied(record, pickled, deep)


@pytest.mark.parametrize("how", ["pickled", "deep"])
def test_a_copy_goes_on_as_the_original_does(copied: Copied, how: str) -> None:
    twin: pw.Walk = pickle.loads(copied.pickled) if how == "pickled" else copied.deep
    assert twin.time == pytest.approx(3.11)  # the original's ticks moved nothing of it
    assert twin.run(until=4.2).record().differences(copied.record) == ()


def test_a_copy_in_another_process_goes_on_as_the_original_does(copied: Copied) -> None:
    def walked_on(walk: pw.Walk) -> pw.Record:
        return walk.run(until=3.3).record()

    walk: pw.Walk = pickle.loads(copied.pickled)
    (far,) = joblib.Parallel(n_jobs=2)([joblib.delayed(walked_on)(walk)])
    assert far.differences(walked_on(walk)) == ()


def test_a_task_of_ones_own_looks_at_the_copys_robot(talos: Robot) -> None:
    """A frame's terms belong to the dynamics that keep them up to date, in a copy to the copy's."""
    walk = pw.Walk.standing(talos)
    terms = walk.walker.body.dynamics.frame("arm_right_7_link")
    twin, twin_terms = copy.deepcopy((walk, terms))
    assert twin.walker.body.dynamics.frame("arm_right_7_link") is twin_terms
    walk.run(until=0.1)
    twin.run(until=0.1)
    assert (twin_terms.jacobian == terms.jacobian).all()
    assert twin_terms.rotation is not terms.rotation
