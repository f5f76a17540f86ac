"""TALOS walks by every CoM generator: along a plan, by command, turning, through a push."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.pattern.com.table import COM_GENERATORS
from preview_walk.robots.robot import Robot

OTHERS = [name for name in COM_GENERATORS if name != "preview"]


@pytest.mark.parametrize("name", OTHERS)
def test_walks_along_a_plan_through_a_push(talos: Robot, name: str) -> None:
    """Forward, 50 N·s, in the middle of a walk like the default one."""
    plan = pw.FootstepPlanner(0.25, talos.step_width, 0.9).generate_footsteps(7, ramp=2)
    push = pw.Push(plan.steps[3].lift + 0.2, 0.2, (250.0, 0.0, 0.0))
    record = pw.simulate(talos, plan, pushes=[push], com_generator=name)
    summary = record.summary()
    assert not summary.fell
    assert summary.qp_failures == 0
    assert record.run.com_generator == name
    undisturbed = record.time < push.t
    error = (record.com - record.com_ref)[undisturbed, :2]
    assert np.sqrt((error**2).mean(axis=0)).max() < 5e-4
    # Nothing asks Wieber's walk for rest: it sways over the soles, and no further.
    away = np.abs(record.com[-1] - 0.5 * (record.left_foot + record.right_foot)[-1, :3, 3])[:2]
    assert (away < (0.105, 0.15)).all()
    if name == "dcm":
        assert np.abs(record.com_velocity[-1]).max() < 0.01


@pytest.mark.parametrize("name", OTHERS)
def test_walks_by_command_and_turns_without_a_step_that_was_not_asked_for(
    talos: Robot, name: str
) -> None:
    """What it foresees of its own DCM is what recovery compares with: nothing is recovered from."""
    walk = pw.Walk.standing(talos, com_generator=name)
    walk.schedule([((0.3, 0.0, 0.2), 3.0)])
    record = walk.run().record()
    assert not record.run.fell
    by_preview = pw.simulate_commands(talos, [((0.3, 0.0, 0.2), 3.0)])
    assert len(record.plans) == len(by_preview.plans)
    assert (record.plans[-1].pose == by_preview.plans[-1].pose).all()


def test_a_copy_goes_on_as_the_original_does(talos: Robot) -> None:
    walk = pw.Walk.standing(talos, com_generator="mpc")
    walk.command(0.3, 0.0, 0.1)
    walk.run(until=1.53)
    twin = pickle.loads(pickle.dumps(walk))
    assert twin.run(until=2.1).record().differences(walk.run(until=2.1).record()) == ()


def test_another_name_is_refused(talos: Robot) -> None:
    with pytest.raises(pw.InvalidInput, match="one of preview, mpc, dcm") as caught:
        pw.Walk.standing(talos, com_generator="lqr")
    assert caught.value.argument == "com_generator"
