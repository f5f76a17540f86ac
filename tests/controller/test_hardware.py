"""What the controller does about delay, noise and friction: the rules, against their reasons."""

from __future__ import annotations

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.hardware import (
    PER_DELAY,
    PLAY,
    SURE,
    Hardware,
    dcm_rate,
    smoothing_time,
)
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.disturbance import ROUGH_SMOOTHING_TIME, SMOOTHING_TIME
from preview_walk.tracking.contacts import sole_cone
from preview_walk.types import Array

OMEGA = 3.5


@pytest.fixture(scope="module")
def g1() -> Robot:
    return pw.load_robot("g1")


def test_without_delay_and_noise_the_feedback_is_as_fast_as_wanted() -> None:
    assert dcm_rate(20.0, OMEGA, 0.0, 0.0, 0.05) == 20.0
    assert dcm_rate(1.0, OMEGA, 0.1, 0.1, 0.01) == 1.0  # slower than any bound: as wanted


@pytest.mark.parametrize("delay", [0.01, 0.02, 0.03])
def test_a_late_feedback_is_damped_critically(delay: float) -> None:
    """The pendulum with a lagging ZMP, written as a matrix: both eigenvalues are the same."""
    rate = dcm_rate(100.0, OMEGA, delay, 0.0, 0.05)
    loop = np.array([[OMEGA, -OMEGA], [(1.0 + rate / OMEGA) / delay, -1.0 / delay]])
    first, second = np.linalg.eigvals(loop)
    assert first == pytest.approx(second, rel=1e-6)
    assert first.real < -OMEGA


def test_noise_does_not_press_the_soles_on_their_edges() -> None:
    """Drawn velocities, through the feedback's own formula: the ZMP wanders by what is allowed."""
    spread, width = 0.005, 0.05
    rate = dcm_rate(100.0, OMEGA, 0.0, spread, width)
    velocity = spread * np.random.default_rng(0).standard_normal(100_000)
    zmp = (1.0 + rate / OMEGA) * velocity / OMEGA
    assert SURE * zmp.std() == pytest.approx(PLAY * width, rel=0.02)
    assert dcm_rate(100.0, OMEGA, 0.0, 1.0, width) == OMEGA  # never slower than the pendulum


def stiff(robot: Robot, share: float) -> Array:
    """Return a dry friction (n,) of so much of every motor's largest torque, N·m."""
    return np.asarray(share * robot.effort)


def test_the_edge_is_what_friction_moves_the_centre_of_pressure_by(g1: Robot) -> None:
    """G1's ankles: 35 N·m. Held back by friction under all the load, a sole is not at its edge."""
    hardware = Hardware(0.0, stiff(g1, 0.02))
    moved = 0.02 * 35.0 / (g1.mass * g1.gravity)
    assert hardware.edge(g1) == pytest.approx(moved)
    assert hardware.pressed_width(g1) + moved == pytest.approx(0.95 * g1.sole.half_width)


def test_the_qp_keeps_off_the_edge(g1: Robot) -> None:
    hardware, sole = Hardware(0.0, stiff(g1, 0.02)), g1.sole
    cone = sole_cone(g1.soles["left"], 0.8, hardware.edge(g1))
    width, length = hardware.pressed_width(g1), 0.95 * sole.half_length - hardware.edge(g1)
    for x, y, inside in [(0.99, 0.99, True), (1.01, 0.0, False), (0.0, 1.01, False)]:
        wrench = np.array((0.0, 0.0, 1.0, y * width, -x * length, 0.0)) * 300.0
        assert ((cone @ wrench).max() <= 0.0) == inside


def test_the_observer_is_as_slow_as_its_answer_is_late(g1: Robot) -> None:
    late = Hardware(0.02, stiff(g1, 0.0))
    assert smoothing_time(None, blind=False) == SMOOTHING_TIME
    assert smoothing_time(late, blind=False) == PER_DELAY * 0.02
    assert smoothing_time(None, blind=True) == ROUGH_SMOOTHING_TIME
    assert smoothing_time(Hardware(1e-4, stiff(g1, 0.0)), blind=False) == SMOOTHING_TIME
