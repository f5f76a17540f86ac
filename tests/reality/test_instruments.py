"""Sensors and drives against what they are said to do, on a robot that is moved by hand."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.reality.drives import Drives
from preview_walk.reality.instruments import Delayed, Instruments
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco

DT = 0.001


def test_a_delay_is_a_delay_and_a_rate_holds() -> None:
    late = Delayed(np.zeros(1), DT, 0.003, 0.0)
    for k in range(1, 10):
        late.put(np.array([float(k)]))
        assert late.value[0] == max(0, k - 3)
    held = Delayed(np.zeros(1), DT, 0.0, 250.0)
    seen = []
    for k in range(1, 13):
        held.put(np.array([float(k)]))
        seen.append(held.value[0])
    assert seen == [0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12]


@pytest.fixture
def stood(talos: Robot) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = copy.deepcopy(talos.mj)
    model.opt.timestep = DT
    data = mujoco.MjData(model)
    to_mujoco(talos.posture, np.zeros(model.nv), data.qpos, data.qvel)
    mujoco.mj_forward(model, data)
    return model, data


def test_what_a_still_robot_reads(
    talos: Robot, stood: tuple[mujoco.MjModel, mujoco.MjData]
) -> None:
    """Gravity's opposite in the base's axes, its angles to half a step of the encoder."""
    model, data = stood
    realism = pw.Realism(encoders=pw.Encoders(bits=12, bandwidth=80.0, delay=0.002))
    sensors = Instruments(talos, model, realism, np.random.default_rng(0))
    sensors.start(data)
    for _ in range(5):
        sensors.sample(data)
    m = sensors.read(0.005)
    assert np.abs(m.angles - data.qpos[7:]).max() <= np.pi / 2**12 + 1e-12
    np.testing.assert_allclose(m.accelerometer, (0.0, 0.0, 9.81), atol=1e-9)
    np.testing.assert_allclose(m.gyro, 0.0, atol=1e-12)
    np.testing.assert_array_equal(m.speeds, 0.0)


def test_speeds_lag_as_a_first_order_filter(
    talos: Robot, stood: tuple[mujoco.MjModel, mujoco.MjData]
) -> None:
    model, data = stood
    realism = pw.Realism(encoders=pw.Encoders(bandwidth=20.0))
    sensors = Instruments(talos, model, realism, np.random.default_rng(0))
    sensors.start(data)
    for _ in range(8):  # joint 0 turns at 1 rad/s
        data.qpos[7] += DT
        sensors.sample(data)
    m = sensors.read(0.008)
    assert m.speeds[0] == pytest.approx(1.0 - np.exp(-0.008 * 2.0 * np.pi * 20.0))


def test_a_motor_lags_and_is_late(
    talos: Robot, stood: tuple[mujoco.MjModel, mujoco.MjData]
) -> None:
    model, data = stood
    realism = pw.Realism(motors=pw.Motors(delay=0.002, bandwidth=50.0, dry_friction=0.02))
    drives = Drives(talos, model, realism, np.random.default_rng(0))
    np.testing.assert_allclose(
        model.dof_frictionloss[6:], talos.mj.dof_frictionloss[6:] + 0.02 * talos.effort
    )
    n = len(talos.effort)
    np.testing.assert_array_equal(drives.act(np.zeros(n), data), 0.0)
    made = [drives.act(np.ones(n), data)[0] for _ in range(10)]
    late = 1.0 - np.exp(-2.0 * np.pi * 50.0 * DT * np.arange(1, 9))
    np.testing.assert_allclose(made, [0.0, 0.0, *late], atol=1e-12)
    strong = drives.act(1e6 * np.ones(n), data)
    assert (np.abs(strong) <= talos.effort).all()


def test_a_fault_of_something_else_is_refused(talos: Robot) -> None:
    realism = pw.Realism.lab().with_fault(pw.Fault("encoder", "nose"))
    with pytest.raises(InvalidInput, match=r"must name one of .*, got 'nose'"):
        pw.RealWorld(talos, realism)
