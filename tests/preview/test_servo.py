"""The online servo: the same law as `track`, limits without windup, states seen by observers."""

import copy
import pickle

import control
import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.observer import kalman_gain, luenberger_gain
from preview_walk.preview.response import track
from preview_walk.preview.servo import PreviewServo, ServoState
from preview_walk.types import Array

A = np.array([[1.02, 0.1, 0.0], [0.0, 0.9, 0.2], [0.0, -0.1, 0.8]])
B = np.array([[0.1, 0.0], [0.5, 0.2], [0.0, 1.0]])
C = np.array([[1.0, 0.0, 0.2], [0.0, 0.5, 1.0]])
E = np.array([[0.1], [0.3], [-0.2]])


def run(
    servo: PreviewServo, r: Array, w: Array, *, feed: str = "", unknown: float = 0.0
) -> tuple[Array, Array]:
    """Return y and u of the plant under the servo; `unknown` pushes on its states all the time."""
    plant, n = servo.design.plant, servo.design.horizon
    ahead = np.vstack([r, np.repeat(r[-1:], n, axis=0)])
    w_ahead = np.vstack([w, np.repeat(w[-1:], n, axis=0)])
    x, state, ys, us = np.zeros(len(plant.A)), servo.start(), [], []
    for k in range(len(r)):
        state = servo.step(state, ahead[k : k + n + 1], w_ahead[k : k + n])
        ys.append(plant.C @ x + plant.D @ state.u)
        us.append(state.u)
        x = plant.A @ x + plant.B @ state.u + plant.E @ w[k] + unknown
        if feed == "measured":
            state = servo.measured(state, x)
        elif feed == "observed":
            state = servo.observed(state, plant.C @ x + plant.D @ state.u)
    return np.array(ys), np.array(us)


def signals(length: int = 120) -> tuple[Array, Array]:
    rng = np.random.default_rng(4)
    return (np.repeat(rng.normal(size=(length // 10, 2)), 10, axis=0),
            np.repeat(rng.normal(size=(length // 10, 1)), 10, axis=0))  # fmt: skip


def design(n: int = 25, feedthrough: float = 0.0, **more: bool) -> PreviewDesign:
    system = (A, B, C, feedthrough * np.eye(2))
    return preview_gains(system, 1.0, 0.05, 0.3, n, E=E, **more)


@pytest.mark.filterwarnings("ignore::preview_walk.preview.horizon.ShortHorizonWarning")
@pytest.mark.parametrize("n", [0, 1, 25])
@pytest.mark.parametrize("integral", [True, False])
@pytest.mark.parametrize("feedthrough", [0.0, 0.4])
def test_steps_are_the_tracking(n: int, integral: bool, feedthrough: bool) -> None:
    own = design(n, feedthrough, integral=integral)
    r, w = signals()
    expected = track(own, r, disturbance=w)
    y, u = run(PreviewServo(own), r, w, feed="measured")
    np.testing.assert_allclose(u, expected.u, atol=1e-10)
    np.testing.assert_allclose(y, expected.y, atol=1e-10)
    if n > 0:  # a disturbance that was seen needs no measurement
        np.testing.assert_allclose(run(PreviewServo(own), r, w)[1], expected.u, atol=1e-9)


@pytest.mark.parametrize("feed", ["measured", "observed"])
def test_integral_action_removes_what_nobody_foresaw(feed: str) -> None:
    own = design()
    gain = kalman_gain(own, 0.1, 0.01)
    r = np.tile([1.0, -0.5], (300, 1))
    y, _ = run(PreviewServo(own, observer_gain=gain), r, np.zeros((300, 1)), feed=feed, unknown=0.1)
    np.testing.assert_allclose(y[-1], r[-1], atol=1e-9)
    assert np.abs(y[5] - r[5]).max() > 1e-3


def test_an_input_at_its_limit_winds_nothing_up() -> None:
    """An integrator of 10 s at the limit comes back without the overshoot of a summed error."""
    own = preview_gains(([[0.98]], [[0.02]], [[1.0]], [[0.0]]), 1.0, 0.0, 0.3, 0)
    servo = PreviewServo(own, u_min=-1.2, u_max=1.2)
    r = np.ones((600, 1))
    y, u = run(servo, r, np.zeros((600, 0)), feed="measured")
    assert np.abs(u).max() == 1.2
    limited = y.max() - 1.0
    total, x, summed = 0.0, 0.0, []
    for _ in range(600):  # the same gains with the error summed, limit or no limit
        total += x - 1.0
        held = np.clip(-own.integral_gain.item() * total - own.state_gain.item() * x, -1.2, 1.2)
        x = 0.98 * x + 0.02 * held
        summed.append(x)
    assert max(summed) - 1.0 > 0.05
    assert limited < 0.25 * (max(summed) - 1.0)
    assert y[-1, 0] == pytest.approx(1.0, abs=1e-6)


def test_observers_have_the_modes_they_were_designed_for() -> None:
    own = design()
    poles = np.array([0.1, 0.2, 0.3])
    gain = luenberger_gain(own, poles)
    found = np.linalg.eigvals((np.eye(3) - gain @ C) @ A)
    np.testing.assert_allclose(np.sort(found.real), poles, atol=1e-9)
    # The Kalman gain is the fixed point of the filter's covariance, iterated.
    q, r = np.diag([0.1, 0.2, 0.3]), np.diag([0.01, 0.05])
    p = np.eye(3)
    for _ in range(300):
        k = p @ C.T @ np.linalg.inv(C @ p @ C.T + r)
        p = A @ (p - k @ C @ p) @ A.T + q
    np.testing.assert_allclose(kalman_gain(own, np.diag(q), np.diag(r)), k, atol=1e-10)


def test_an_observer_finds_a_state_that_is_not_measured() -> None:
    own = design()
    servo = PreviewServo(own, observer_gain=luenberger_gain(own, [0.1, 0.2, 0.3]))
    state, x = servo.start(), np.array([0.5, -0.3, 0.2])
    gaps = []
    for _ in range(15):
        state = servo.step(state, np.zeros((26, 2)))
        x = A @ x + B @ state.u
        state = servo.observed(state, C @ x)
        gaps.append(np.abs(state.x - x).max())
    assert gaps[-1] < 1e-5 * gaps[0]


def test_states_and_servos_are_values() -> None:
    servo = PreviewServo(design(), u_max=1.0)
    state = servo.step(servo.start([1.0, 0.0, 0.0]), np.ones((26, 2)))
    for copied in (pickle.loads(pickle.dumps((servo, state))), copy.deepcopy((servo, state))):
        again: PreviewServo = copied[0]
        found: ServoState = copied[1]
        assert not found.x.flags.writeable
        np.testing.assert_array_equal(
            again.step(found, np.ones((26, 2))).u, servo.step(state, np.ones((26, 2))).u
        )


def test_refusals() -> None:
    servo = PreviewServo(design())
    state = servo.start()
    for call, argument in (
        (lambda: servo.step(state, np.ones((25, 2))), "window"),
        (lambda: servo.step(state, np.full((26, 2), np.nan)), "window"),
        (lambda: servo.step(state, np.ones((26, 2)), np.ones(26)), "disturbance"),
        (lambda: servo.measured(state, [1.0]), "x"),
        (lambda: servo.observed(state, [1.0, 1.0]), "observer_gain"),
        (lambda: servo.start("here"), "x"),
        (lambda: PreviewServo(servo.design, u_min=1.0, u_max=0.0), "u_min"),
        (lambda: PreviewServo(servo.design, u_max=[1.0, 2.0, 3.0]), "u_max"),
        (lambda: PreviewServo(servo.design, observer_gain=1.0), "observer_gain"),
        (lambda: luenberger_gain(servo.design, [1.5, 0.0, 0.0]), "poles"),
        (lambda: luenberger_gain(servo.design, "fast"), "poles"),
        (lambda: kalman_gain(servo.design, 1.0, 0.0), "output_noise"),
    ):
        with pytest.raises(InvalidInput) as caught:
            call()
        assert caught.value.argument == argument


def test_control_is_what_designs_the_kalman_gain() -> None:
    own = design()
    predictor = control.dlqe(A, np.eye(3), C, 0.1 * np.eye(3), 0.05 * np.eye(2))[0]
    np.testing.assert_allclose(A @ kalman_gain(own, 0.1, 0.05), predictor, atol=1e-12)
