"""What is asked of a walk under way: pushes and gains; by the loop's thread and by another."""

from __future__ import annotations

import copy
import pickle
import threading
from dataclasses import replace

import mujoco
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot


def test_a_push_under_way_is_one_known_beforehand(talos: Robot) -> None:
    """Bit for bit: the same force from the same tick on."""
    known = pw.Walk.standing(talos, pushes=[pw.Push(0.3, 0.1, (60.0, 30.0, 0.0))])
    known.run(until=0.8)
    walk = pw.Walk.standing(talos)
    walk.run(until=0.3)
    walk.push((60.0, 30.0, 0.0), 0.1)
    walk.run(until=0.8)
    record, other = walk.record(), known.record()
    np.testing.assert_array_equal(record.push, other.push)
    np.testing.assert_array_equal(record.q, other.q)
    assert record.run.pushes[0]["t"] == pytest.approx(0.3)
    assert np.abs(record.push[:, 0]).sum() * record.dt == pytest.approx(6.0)


def test_a_push_in_a_scene_of_ones_own_on_a_body(talos: Robot) -> None:
    model = pw.World(talos).model
    walk = pw.Walk.standing(pw.Scene(pw.load_robot(model), model, mujoco.MjData(model)))
    walk.push((0.0, 40.0, 0.0), 0.1, body="torso_2_link")
    walk.run(until=0.2)
    assert walk.record().run.pushes[0]["body"] == "torso_2_link"
    assert walk.record().push[:, 1].max() == 40.0
    with pytest.raises(InvalidInput, match="names the body 'tail'"):
        walk.push((0.0, 40.0, 0.0), 0.1, body="tail")


def test_other_gains_from_the_same_tick_on_walk_as_if_made_of_them(talos: Robot) -> None:
    gains = pw.TrackingGains(dcm=12.0, foot=30.0, posture_weight=0.01, momentum_weight=1e-3)
    made = pw.Walk.standing(talos, gains=gains)
    tuned = pw.Walk.standing(talos)
    tuned.gains = gains
    for walk in (made, tuned):
        walk.command(0.2, 0.0, 0.0)
        walk.run(until=1.0)
    assert tuned.gains == gains
    np.testing.assert_array_equal(made.record().q, tuned.record().q)
    run = tuned.record().run
    assert run.gains["dcm"] == pw.TrackingGains().dcm
    assert [(change["t"], change["gains"]["dcm"]) for change in run.retuned] == [(0.0, 12.0)]


def test_other_gains_reach_what_was_made_before(talos: Robot) -> None:
    """A copy has no problems left of the old gains; the walk itself must not use them either."""
    walk = pw.Walk.standing(talos)
    walk.command(0.2, 0.0, 0.0)
    walk.run(until=1.2)
    twin = copy.deepcopy(walk)
    for one in (walk, twin):
        one.gains = replace(one.gains, foot=40.0, posture_weight=0.02, wrench_weight=0.01)
        one.run(until=2.0)
    np.testing.assert_array_equal(walk.record().q, twin.record().q)


def test_a_task_of_ones_own_outlives_a_change_of_gains(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    body = walk.walker.body
    own = copy.deepcopy(body.torso)
    body.add_task(own)
    walk.gains = replace(walk.gains, torso=20.0)
    assert body.tasks[-1] is own
    assert len(body.tasks) == 3
    walk.run(until=0.1)
    assert not walk.fallen


def test_gains_too_fast_for_the_ticks_are_refused(talos: Robot) -> None:
    walk = pw.Walk.standing(talos, control_hz=100, physics_hz=1000)
    with pytest.raises(InvalidInput, match="control_hz must be at least 120"):
        walk.gains = replace(walk.gains, foot=60.0)
    assert walk.gains == pw.TrackingGains()


def test_pushes_and_gains_come_from_any_thread(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)

    def ask() -> None:
        while walk.time < 0.1:
            pass
        walk.push((30.0, 0.0, 0.0), 0.1)
        walk.gains = replace(walk.gains, dcm=15.0)

    other = threading.Thread(target=ask)
    other.start()
    walk.run(until=0.5)
    other.join()
    walk.run(until=0.6)
    assert len(walk.record().run.pushes) == 1
    assert walk.gains.dcm == 15.0


def test_a_steered_walk_pickles_and_its_record_too(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    walk.push((30.0, 0.0, 0.0), 0.1)
    walk.gains = replace(walk.gains, dcm=15.0)
    walk.run(until=0.05)
    twin = pickle.loads(pickle.dumps(walk))
    records = [one.run(until=0.3).record() for one in (walk, twin)]
    assert records[0].physical_equal(records[1])
    assert pickle.loads(pickle.dumps(records[0])).run == records[0].run


def test_an_interrupted_walk_says_so_and_goes_on_no_more(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    walk.run(until=0.1)
    walk.interrupt()
    assert walk.interrupted
    assert walk.finished
    assert walk.run(until=0.5).time == pytest.approx(0.1)
    assert walk.record().run.interrupted
    assert walk.fall_reason == ""
