"""Copies of a walk, pickled or deep, go on bit for bit as the original does."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable

import joblib
import pytest

import preview_walk as pw
from preview_walk.robots.robot import Robot


def busy_walk(robot: Robot) -> pw.Walk:
    """Return a walk in the middle of a push and of a swing, by command."""
    walk = pw.Walk.standing(robot, pushes=[pw.Push(3.0, 0.2, (250.0, 80.0, 0.0))])
    walk.command(0.6, 0.0, 0.1)
    return walk.run(until=3.11)


def pickled(walk: pw.Walk) -> pw.Walk:
    copied: pw.Walk = pickle.loads(pickle.dumps(walk))
    return copied


@pytest.mark.parametrize("copied", [pickled, copy.deepcopy])
def test_a_copy_goes_on_as_the_original_does(
    talos: Robot, copied: Callable[[pw.Walk], pw.Walk]
) -> None:
    walk = busy_walk(talos)
    twin = copied(walk)
    assert twin.plant is not walk.plant
    walk.run(until=4.2)
    assert twin.time == pytest.approx(3.11)  # the original's ticks moved nothing of it
    twin.run(until=4.2)
    assert twin.record().differences(walk.record()) == ()
    assert len(walk.record().plans) > 3


def test_a_copy_in_another_process_goes_on_as_the_original_does(talos: Robot) -> None:
    def walked_on(walk: pw.Walk) -> pw.Record:
        return walk.run(until=3.3).record()

    walk = busy_walk(talos)
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
