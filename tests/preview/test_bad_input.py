"""Whatever is passed to a public call of the room, the answer is a result or one sentence."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import control
import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.compare import compare
from preview_walk.preview.comparison_plot import plot_comparison
from preview_walk.preview.controller import PreviewController
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.half_planes import half_planes
from preview_walk.preview.increments import with_increments
from preview_walk.preview.least_input import LeastInputServo
from preview_walk.preview.limits import Limits
from preview_walk.preview.mpc import PredictiveServo
from preview_walk.preview.observer import kalman_gain, luenberger_gain
from preview_walk.preview.response import preview_effect, track
from preview_walk.preview.servo import PreviewServo
from preview_walk.preview.systems import closed_loop_system, preview_filter, servo_system
from preview_walk.preview.zmp_mpc import zmp_mpc

K = cart_table(0.814, 0.005)
GIVEN: dict[str, Any] = {"system": K, "Q_e": 1.0, "Q_x": 0.0, "R": 1e-6, "N": 50}
WALK = PreviewController()
STILL = WALK.initial_state((0.0, 0.0))
SMALL = preview_gains(
    ([[0.9, 0.1], [0.0, 0.8]], [[0.0], [1.0]], [[1.0, 0.0]], [[0.0]]), 1, 0, 0.1, 30, E=[1, 0]
)
SERVO = PreviewServo(SMALL, observer_gain=kalman_gain(SMALL, 0.1, 0.1))
START, WINDOW = SERVO.start(), np.zeros((31, 1))
TWO = preview_gains((0.9 * np.eye(2), np.eye(2), np.eye(2), np.zeros((2, 2))), 1, 0, 0.1, 30)
SOLE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]

LAWS = compare(SMALL, [0.0, 1.0], laws=("LQI",))

BAD: list[Any] = [
    None, "x", True, np.nan, np.inf, -np.inf, -1, 0, 1e308, 1e-308, 1e30, 10**400, 1j, [], [[]], {},
    object(), [1, 2], [[1, "a"]], np.ones((2, 2, 2)), np.zeros((0, 0)), 1e-9, 1e9, [[1], [1, 2]],
    np.array("2020", dtype="datetime64"), int, np.ma.masked, np.full((3, 3), 1e200),
    Decimal("0.1"), Fraction(1, 3), np.True_, b"1", np.zeros((3, 0)), control.tf([1, 0], [1]), K,
    control.tf([[[1], [1, 2]], [[1], [1]]], [[[1, 2], [1, 2]], [[1, 3], [1, 4]]], 0.1),
]  # fmt: skip

CALLS: dict[str, Callable[[Any], object]] = {
    **{name: (lambda b, n=name: preview_gains(**{**GIVEN, n: b}))  # type: ignore[misc]
       for name in (*GIVEN, "E", "dt", "final_cost", "integral")},
    **{f"{name} without integral action":
       (lambda b, n=name: preview_gains(**{**GIVEN, n: b, "integral": False}))  # type: ignore[misc]
       for name in (*GIVEN, "E")},
    "increments": with_increments,
    "increments' dt": lambda b: with_increments(cart_table(0.8), b),
    "increments' E": lambda b: with_increments(K, E=b),
    "A": lambda b: preview_gains((b, K.B, K.C, K.D), 1.0, 0.0, 1e-6, 50),
    "D": lambda b: preview_gains((K.A, K.B, K.C, b), 1.0, 0.0, 1e-6, 50),
    "time base": lambda b: preview_gains((K.A, K.B, K.C, K.D, b), 1.0, 0.0, 1e-6, 50),
    "sampling": lambda b: preview_gains(cart_table(0.8), 1.0, 0.0, 1e-6, 50, dt=b),
    **{f"controller {name}": (lambda b, n=name: PreviewController(**{n: b}))  # type: ignore[misc]
       for name in ("z_c", "dt", "preview_time", "q_e", "q_x", "r")},
    "zmp_ref": WALK.trajectory,
    "x0": lambda b: WALK.trajectory([[0.0, 0.0]], b),
    "t": lambda b: WALK.trajectory([0.0, 0.0], t=b),
    "zmp_window": lambda b: WALK.step(STILL, b),
    "state": lambda b: WALK.step(b, np.zeros((100, 2))),
    "tau": lambda b: WALK.interpolate(STILL, STILL, b),
    "velocity": lambda b: WALK.initial_state((0.0, 0.0), b),
    "cart_table": cart_table,
    "gravity": lambda b: cart_table(0.8, 0.01, b),
    "design": lambda b: track(b, [0.0]),
    "reference": lambda b: track(SMALL, b),
    "disturbance": lambda b: track(SMALL, [0.0, 1.0], disturbance=b),
    "horizons": lambda b: preview_effect(SMALL, [0.0, 1.0], b),
    "horizon": lambda b: preview_effect(SMALL, [0.0, 1.0], [b]),
    "servo design": PreviewServo,
    "servo limit": lambda b: PreviewServo(SMALL, u_max=b),
    "servo window": lambda b: SERVO.step(START, b),
    "servo disturbance": lambda b: SERVO.step(START, WINDOW, b),
    "servo state": lambda b: SERVO.step(b, WINDOW),
    "measured": lambda b: SERVO.measured(START, b),
    "observed": lambda b: SERVO.observed(START, b),
    "kalman": lambda b: kalman_gain(SMALL, b, 0.1),
    "kalman output": lambda b: kalman_gain(SMALL, 0.1, b),
    "poles": lambda b: luenberger_gain(SMALL, b),
    "systems": lambda b: (preview_filter(b), servo_system(b), closed_loop_system(b)),
    "laws": lambda b: compare(SMALL, [0.0, 1.0], laws=b),
    "limits": lambda b: compare(SMALL, [0.0, 1.0], limits=b),
    "y_max": lambda b: compare(SMALL, [0.0, 1.0], limits=Limits(y_max=b), laws=("MPC",)),
    "u_min": lambda b: compare(SMALL, [0.0, 1.0], limits=Limits(u_min=b), laws=("MPC",)),
    "u_max of Wieber's": lambda b: LeastInputServo(SMALL, Limits(u_max=b)),
    "servo limits": lambda b: PredictiveServo(SMALL, b),
    "y_limits": lambda b: PredictiveServo(SMALL, Limits()).step(START, WINDOW, y_limits=b),
    "polygons": lambda b: compare(TWO, np.zeros((2, 2)), limits=Limits(polygons=b)),
    "a polygon": lambda b: compare(TWO, np.zeros((2, 2)), limits=Limits(polygons=[SOLE, b])),
    "one output's": lambda b: compare(SMALL, [0.0, 1.0], limits=Limits(polygons=b)),
    "polygon": half_planes,
    "supports": lambda b: zmp_mpc(b, 0.8, 0.1),
    "height": lambda b: zmp_mpc([SOLE], b, 0.1),
    "zmp dt": lambda b: zmp_mpc([SOLE], 0.8, b),
    "zmp preview": lambda b: zmp_mpc([SOLE], 0.8, 0.1, b),
    "path": lambda b: plot_comparison(LAWS, b),
}  # fmt: skip


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_the_answer_is_a_result_or_one_sentence(call: Callable[[Any], object]) -> None:
    for bad in BAD:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                call(bad)
            except InvalidInput as error:
                sentence = str(error)
                assert sentence.startswith("expected "), sentence
                assert sentence.endswith("."), sentence
                assert "\n" not in sentence
                assert error.argument, sentence  # noqa: PT017


def test_weights_of_every_size() -> None:
    """Twenty-four decades of each: a servo, or a sentence that says what could not be solved."""
    refused = 0
    for q_e in 10.0 ** np.arange(-12, 13):
        for r in 10.0 ** np.arange(-14, 4):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    design = preview_gains(K, q_e, 0.0, r, 20)
                except InvalidInput:
                    refused += 1
                else:
                    assert np.isfinite(design.feedback).all()
                    assert design.residual < 1e-8
    assert refused < 200


def test_random_plants_and_ill_conditioned_weights() -> None:
    """Where R + G' P G is singular to rounding, the sentence says so: no bare LinAlgError."""
    rng, designed = np.random.default_rng(0), 0
    for trial in range(400):
        n, m, p = rng.integers(1, 6), rng.integers(1, 4), rng.integers(1, 4)
        a = rng.normal(size=(n, n)) * 10 ** rng.uniform(-2, 1)
        b = rng.normal(size=(n, m)) * 10 ** rng.uniform(-6, 6)
        c = rng.normal(size=(p, n)) * 10 ** rng.uniform(-6, 6)
        d = rng.normal(size=(p, m)) * rng.integers(0, 2)
        q_e, r = ((7e6, 4e-12), (3e8, 6e-11), (1.0, 1.0))[trial % 3]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                design = preview_gains((a, b, c, d), q_e, 0.0, r, 3, integral=bool(trial % 2))
            except InvalidInput:
                continue
        designed += 1
        assert np.isfinite(design.feedback).all()
    assert designed > 150


def test_plants_and_weights_near_the_ends_of_what_numbers_hold() -> None:
    """Products overflow, vanish or are singular: what linear algebra says becomes a sentence."""
    rng, designed, unsolved = np.random.default_rng(4), 0, 0

    def size() -> float:
        return 10.0 ** float(rng.choice([0, 0, 0, 0, -20, 20, 100, 150, -300, 300]))

    for trial in range(400):
        n, m, p = rng.integers(1, 4), rng.integers(1, 4), rng.integers(1, 4)
        a, b, c = rng.normal(size=(n, n)), rng.normal(size=(n, m)), rng.normal(size=(p, n))
        d = rng.normal(size=(p, m)) * rng.integers(0, 2)
        final = {"final_cost": size()} if trial % 5 == 0 else {"integral": bool(trial % 2)}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                plant = (a * size(), b * size(), c * size(), d * size())
                design = preview_gains(plant, size(), size() * (trial % 3), size(), 3, **final)
                LeastInputServo(design, Limits())
                PredictiveServo(design, Limits())
                preview_effect(design, np.ones((3, p)), [0, 3])
            except InvalidInput as error:
                unsolved += isinstance(error.__cause__, np.linalg.LinAlgError)
                continue
        designed += 1
    assert designed > 20, (designed, unsolved)
    assert unsolved > 3


@pytest.mark.parametrize(("q_e", "r"), [(7e6, 4e-12), (3e8, 6e-11)])
def test_inputs_that_only_tiny_weights_tell_apart(q_e: float, r: float) -> None:
    with pytest.raises(InvalidInput) as caught:
        preview_gains(([[0.9]], [[1.0, 1.0]], [[1.0]], [[0.0, 0.0]]), q_e, 0.0, r, 3)
    assert caught.value.argument == "R"
