"""Whole walks in one call: what they refuse, and that commands come at their times."""

from __future__ import annotations

import re

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.robot_limits import gait_limits
from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot


@pytest.fixture(scope="module")
def talos() -> Robot:
    return pw.load_robot("talos")


def test_a_step_that_cannot_be_is_refused(talos: Robot) -> None:
    planner = pw.FootstepPlanner(step_length=0.8, step_width=talos.step_width, step_time=0.9)
    reach = gait_limits(talos).forward
    sentence = (
        "the plan cannot be walked: at 2.320 s step 1 lands 0.800 m ahead of the right sole, at "
        f"most {reach:.3f} m is allowed (1 more)."
    )
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        pw.simulate(talos, planner.generate_footsteps(3))


@pytest.mark.parametrize("length", [0.5, 0.6])
def test_the_long_steps_of_fast_walks_are_not(talos: Robot, length: float) -> None:
    planner = pw.FootstepPlanner(length, talos.step_width, 0.62, 0.05)
    pw.require_walkable(planner.generate_footsteps(20, ramp=5), gait_limits(talos))


def test_scheduled_commands_come_at_their_times_and_end_in_a_stop(talos: Robot) -> None:
    obeyed: list[tuple[float, tuple[float, ...]]] = []

    def watch(walk: pw.Walk) -> None:
        current = walk._commands.current
        if current != (obeyed[-1][1] if obeyed else (0.0, 0.0, 0.0)):
            obeyed.append((walk.time, current))

    walk = pw.Walk.standing(talos, (1.0, 2.0, np.pi / 2), on_tick=watch)
    walk.schedule([((0.2, 0.0, 0.0), 1.0), ((0.0, 0.0, 0.3), 0.25)])
    record = walk.run().record()
    times, velocities = zip(*obeyed, strict=True)
    assert velocities == ((0.2, 0.0, 0.0), (0.0, 0.0, 0.3), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(times, [0.0, 1.0, 1.25], atol=1e-9)
    assert not walk.fallen
    assert record.time[-1] >= walk.plan.end


@pytest.mark.parametrize(
    ("command", "duration", "sentence"),
    [
        ((0.1, 0.0, 0.0), 0.0, "duration must be > 0 s, got 0.0."),
        (
            (np.nan, 0.0, 0.0),
            1.0,
            "a velocity command must be (vx, vy, yaw rate), finite, in m/s and rad/s, "
            "got (nan, 0.0, 0.0).",
        ),
    ],
)
def test_commands_that_cannot_be_are_refused(
    talos: Robot, command: tuple[float, float, float], duration: float, sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        pw.simulate_commands(talos, [(command, duration)])
