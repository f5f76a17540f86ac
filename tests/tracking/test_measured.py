"""Measured states that cannot be stop a walk with one sentence; those that can pass."""

from __future__ import annotations

import re

import numpy as np
import pinocchio as pin
import pytest
from tracking.states import random_state, standing_controller

import preview_walk as pw
from preview_walk.robots.robot import Robot
from preview_walk.tracking.measured import FASTEST, StateError, check_state
from preview_walk.types import Array


def spoilt(values: Array, index: int, value: float) -> Array:
    values = values.copy()
    values[index] = value
    return values


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_named(talos: Robot, value: float) -> None:
    body = standing_controller(talos)
    q, v = random_state(talos, 0)
    joint = talos.joint_names.index("leg_left_4_joint")
    said = f"the measured state must be finite, got {value} for the "
    for a, b, where in (
        (q, spoilt(v, 6 + joint, value), "velocity of joint 'leg_left_4_joint'."),
        (spoilt(q, 7 + joint, value), v, "position of joint 'leg_left_4_joint'."),
        (q, spoilt(v, 2, value), "velocity of the base."),
        (spoilt(q, 3, value), v, "position of the base."),
    ):
        with pytest.raises(StateError, match=f"^{re.escape(said + where)}$"):
            body.update(a, b)


@pytest.mark.filterwarnings("ignore:overflow")
@pytest.mark.parametrize("speed", [1e3, 1e6, -1e150, 1e308])
def test_a_joint_faster_than_sound_is_named_with_the_bound(robot: Robot, speed: float) -> None:
    q, v = random_state(robot, 0)
    bound = FASTEST / robot.leg_length
    said = (
        f"the measured speed of joint '{robot.joint_names[3]}' must be within {bound:.0f} rad/s, "
        f"at which the leg would be as fast as sound, got {speed:.3g} rad/s."
    )
    if abs(speed) > bound:
        with pytest.raises(StateError, match=f"^{re.escape(said)}$"):
            check_state(q, spoilt(v, 9, speed), robot)
    else:
        check_state(q, spoilt(v, 9, speed), robot)
    check_state(q, spoilt(v, 9, np.copysign(0.99 * bound, speed)), robot)


@pytest.mark.parametrize(
    ("index", "value", "said"),
    [
        (slice(3, 7), 0.0, "a unit quaternion, got one of length 0."),
        (slice(3, 7), 1.0, "a unit quaternion, got one of length 2."),
        (slice(3, 7), 1e200, "a unit quaternion, got one of length"),
        (0, 1e7, "the measured base must be within 1e+06 m of the origin, got 1e+07 m."),
        (9, 1e4, "the measured position of joint"),
        (9, -1e150, "a turn beyond its stops, got -1e+150 rad."),
    ],
)
@pytest.mark.filterwarnings("ignore:overflow")
def test_positions_that_cannot_be(talos: Robot, index: int, value: float, said: str) -> None:
    q, v = random_state(talos, 0)
    q[index] = value
    with pytest.raises(StateError, match=re.escape(said)):
        check_state(q, v, talos)


def test_states_of_another_form(talos: Robot) -> None:
    q, v = random_state(talos, 0)
    for a, b, name in (
        (q[:-1], v, "q"),
        (q, np.append(v, 0.0), "v"),
        (q[None], v, "q"),
        (q, None, "v"),
        ("text", v, "q"),
        (q + 0j, v, "q"),
    ):
        with pytest.raises(StateError, match=f"^the measured {name} must be "):
            check_state(a, b, talos)  # type: ignore[arg-type]


def test_every_state_near_the_posture_can_be(robot: Robot) -> None:
    """Also turned at will, far away, in a hurry, and with joints at their stops."""
    rng = np.random.default_rng(0)
    for seed in range(20):
        q, v = random_state(robot, seed)
        q[:3] += 1e4 * rng.standard_normal(3)
        check_state(q, 5.0 * v, robot)
        q[7:] = np.where(np.isfinite(robot.q_upper), robot.q_upper + 0.5, 20.0)
        check_state(q, v, robot)
    assert pin.isNormalized(robot.pin, robot.posture)


@pytest.mark.parametrize(
    ("field", "index", "value", "said"),
    [
        ("qvel", 12, 1e6, "the measured speed of joint '"),
        ("qvel", 12, 1e150, "the measured speed of joint '"),
        ("qpos", slice(3, 7), 0.0, "a unit quaternion, got one of length 0."),
        ("qpos", 9, np.nan, "the measured state must be finite, got nan for the position of joint"),
    ],
)
def test_one_absurd_tick_stops_a_walk_and_its_record_is_finite(
    talos: Robot, field: str, index: int, value: float, said: str
) -> None:
    walk = pw.Walk.standing(talos).run(until=0.1)
    assert isinstance(walk.plant, pw.World)
    getattr(walk.plant.data, field)[index] = value
    walk.run(until=0.2)
    record = walk.record()
    assert walk.fallen
    assert record.run.fall_time == pytest.approx(0.1)
    assert said in str(record.run.fall_reason)
    assert len(record) == 50
    assert all(np.isfinite(record.arrays()[name]).all() for name in ("q", "v", "tau"))
    assert record.qp_status.max() == 0


def test_a_force_that_is_no_number_stops_a_walk(talos: Robot) -> None:
    walk = pw.Walk.standing(talos).run(until=0.1)
    wrench = {foot: wrench.copy() for foot, wrench in walk.plant.wrench.items()}
    wrench["left"][4] = np.nan
    with pytest.raises(StateError, match=r"nan, .* for the wrench on the left sole"):
        walk.walker.tick(0.1, walk.plant.q, walk.plant.v, wrench)
