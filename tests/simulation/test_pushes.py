"""Pushes: their impulse arrives, no more and no less, and a walking robot gets over them."""

from __future__ import annotations

import re
from typing import Any

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.world import World
from preview_walk.types import Array

HZ = 1000


def momenta(robot: Robot, pushes: list[Push], seconds: float, hz: int = HZ) -> tuple[Array, Array]:
    """Return the linear and angular momentum (3,) given to a robot that floats without gravity.

    By Pinocchio, about the CoM; the joints are held by nothing.
    """
    world = World(robot, physics_hz=hz, pushes=pushes)
    world.model.opt.gravity[:] = 0.0
    world.model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    world.place(np.array(robot.posture), 0.0)
    world.step(np.zeros(robot.pin.nv - 6), round(seconds * hz))
    world.sense()
    data = robot.pin.createData()
    momentum = pin.computeCentroidalMomentum(robot.pin, data, world.q, world.v)
    return np.array(momentum.linear), np.array(momentum.angular)


@pytest.mark.parametrize(
    ("t", "duration", "hz"), [(0.01, 0.1, 1000), (1.0, 0.2, 1000), (0.3, 0.05, 500)]
)
def test_the_impulse_is_force_times_duration(
    talos: Robot, t: float, duration: float, hz: int
) -> None:
    """To a thousandth, also a second into the run, where summed time steps are off."""
    force = (12.0, -7.0, 4.0)
    given, _ = momenta(talos, [Push(t, duration, force)], t + duration + 0.05, hz)
    assert given == pytest.approx(np.array(force) * duration, rel=1e-3)


def test_two_at_once_add_up_and_none_is_left_behind(talos: Robot) -> None:
    first, second = Push(0.0, 0.1, (10.0, 0.0, 0.0)), Push(0.05, 0.1, (0.0, 20.0, 0.0))
    given, _ = momenta(talos, [first, second], 0.4)
    assert given == pytest.approx((1.0, 2.0, 0.0), abs=2e-3)


def test_a_push_beside_the_centre_turns_the_robot(talos: Robot) -> None:
    """The moment is lever times force, whatever body is pushed."""
    body, point = "arm_left_7_link", (0.02, 0.01, -0.05)
    world = World(talos, physics_hz=HZ)
    world.place(np.array(talos.posture), 0.0)
    data = world.data
    at = data.body(body).xpos + data.body(body).xmat.reshape(3, 3) @ point
    lever = at - data.subtree_com[0]
    force = np.array((3.0, 2.0, -4.0))
    duration = 0.01
    push = Push(0.0, duration, (3.0, 2.0, -4.0), body=body, point=point)
    linear, angular = momenta(talos, [push], duration)
    assert linear == pytest.approx(force * duration, rel=1e-2)
    assert angular == pytest.approx(np.cross(lever, force) * duration, rel=2e-2, abs=1e-3)


def test_a_point_is_one_of_the_body_however_that_is_turned(talos: Robot) -> None:
    """In the base's own axes, in which MuJoCo has its moment, it is lever times force."""
    world = World(talos, pushes=[Push(0.0, 1.0, (3.0, 2.0, -4.0), point=(0.3, 0.1, -0.2))])
    turned = np.array(talos.posture)
    turned[3:7] = pin.Quaternion(pin.rpy.rpyToMatrix(0.3, -0.4, 2.0)).coeffs()
    world.place(turned, 0.0)
    world.step(np.zeros(talos.pin.nv - 6), 1)
    axes = pin.Quaternion(turned[3:7]).toRotationMatrix()
    moment = np.cross((0.3, 0.1, -0.2), axes.T @ (3.0, 2.0, -4.0))
    assert world.data.qfrc_applied[:3] == pytest.approx((3.0, 2.0, -4.0))
    assert world.data.qfrc_applied[3:6] == pytest.approx(moment, abs=1e-9)


def test_without_a_body_the_base_is_pushed(talos: Robot) -> None:
    pushed, expected = (
        momenta(talos, [Push(0.0, 0.05, (50.0, -20.0, 0.0), body=body)], 0.1)
        for body in (None, "base_link")
    )
    assert np.array(pushed).tolist() == np.array(expected).tolist()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((-0.1, 0.2, (1, 0, 0)), "t must be >= 0 s, got -0.1."),
        ((float("nan"), 0.2, (1, 0, 0)), "t must be >= 0 s, got nan."),
        ((0.0, 0.0, (1, 0, 0)), "duration must be > 0 s, got 0.0."),
        ((0.0, float("inf"), (1, 0, 0)), "duration must be > 0 s, got inf."),
        (
            (0.0, 0.2, (1, 0)),
            "force must be three numbers between -100000 and 100000 N, got (1, 0).",
        ),
        (
            (0.0, 0.2, (1, 0, float("inf"))),
            "force must be three numbers between -100000 and 100000 N, got (1, 0, inf).",
        ),
        (
            (0.0, 0.2, (1, 0, 0), None, (0, 0)),
            "point must be three numbers between -1e+09 and 1e+09 m, got (0, 0).",
        ),
    ],
)
def test_pushes_that_cannot_be_are_refused(arguments: Any, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        Push(*arguments)


def test_an_unknown_body_is_named_beside_those_there_are(
    talos: Robot, short_plan: FootstepPlan
) -> None:
    push = Push(1.0, 0.2, (1.0, 0.0, 0.0), body="nose")
    with pytest.raises(InvalidInput) as error:
        pw.Walk(talos, short_plan, pushes=[push])
    words = str(error.value)
    assert words.startswith("a push names the body 'nose'; the robot has base_link, ")
    assert "torso_2_link" in words


@pytest.mark.parametrize(
    "impulse", [(30.0, 0.0), (-20.0, 0.0), (0.0, 10.0), (0.0, -10.0), (8.0, 8.0)]
)
def test_walks_on_after_a_push(
    talos: Robot, short_plan: FootstepPlan, impulse: tuple[float, float]
) -> None:
    """Of 0.2 s in a single support: past the project's first sketch, which took 30 and 10 N·s."""
    start = short_plan.steps[2].lift + 0.15
    force = (impulse[0] / 0.2, impulse[1] / 0.2, 0.0)
    record = pw.simulate(talos, short_plan, pushes=[Push(start, 0.2, force)])
    summary = record.summary()
    assert not summary.fell, summary.fall_reason
    assert summary.final_position_error is not None
    assert summary.final_position_error < 0.05
    assert summary.steps >= 5
    # The record knows the force, and the DCM shows it until the feet oppose it.
    pushed = record.time[np.abs(record.push).sum(axis=1) > 0.0]
    assert len(pushed) == pytest.approx(100, abs=1)
    assert pushed[0] == pytest.approx(start, abs=2 * record.dt)
    assert record.push[np.searchsorted(record.time, start + 0.1)] == pytest.approx(force)
    before, after = np.searchsorted(record.time, (start - 0.002, start + 0.02))
    error = (record.dcm - record.dcm_ref)[[before, after]]
    assert (error[1] - error[0]) @ impulse > 0.0


def test_a_strong_push_moves_the_next_foothold_its_way(
    talos: Robot, short_plan: FootstepPlan
) -> None:
    step = short_plan.steps[2]
    push = Push(step.lift + 0.05, 0.2, (300.0, 0.0, 0.0))
    record = pw.simulate(talos, short_plan, pushes=[push])
    assert not record.run.fell
    assert len(record.plans) > 1
    planned = record.plans[0].pose[4]
    walked = record.plans.walked(record.time[-1]).pose[4]
    assert walked[0, 3] - planned[0, 3] > 0.03
