"""Predictive control: its programme written out in full, and walks within support polygons."""

import numpy as np
import pytest
import qpsolvers
from preview.brute_force import least_squares, motion

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.half_planes import half_planes
from preview_walk.preview.least_input import LeastInputServo
from preview_walk.preview.limits import Limits
from preview_walk.preview.mpc import PredictiveServo
from preview_walk.preview.response import track
from preview_walk.preview.zmp_mpc import zmp_mpc
from preview_walk.types import Array

A = np.array([[1.02, 0.1, 0.0], [0.0, 0.9, 0.2], [0.0, -0.1, 0.8]])
B = np.array([[0.1, 0.0], [0.5, 0.2], [0.0, 1.0]])
C = np.array([[1.0, 0.0, 0.2], [0.0, 0.5, 1.0]])
E = np.array([[0.1], [0.3], [-0.2]])


def design(feedthrough: float = 0.0) -> PreviewDesign:
    return preview_gains((A, B, C, feedthrough * np.eye(2)), 1.0, 0.05, 0.3, 20, E=E)


def written_out(
    own: PreviewDesign, limits: Limits, future: tuple[Array, Array], x0: Array
) -> Array:
    """Return u(0) of the programme over all inputs of the horizon, solved by daqp."""
    plant, (r, w) = own.plant, future
    weights = own.Q_e, own.Q_x, own.R
    matrix, right = least_squares(plant, weights, (r, w), x0, final=own.riccati)
    free, forced = motion(plant, w, x0)
    h, m = len(w), 2
    held = np.eye(h * m).reshape(h, m, h * m)
    outputs = np.einsum("pn,knu->kpu", C, forced[:h]) + np.einsum("pm,kmu->kpu", plant.D, held)
    rows = np.vstack([held.reshape(-1, h * m), outputs.reshape(-1, h * m)])
    known = np.concatenate([np.zeros(h * m), (free[:h] @ C.T).ravel()])
    high = np.repeat([limits.u_max, limits.y_max], h * m) - known
    low = np.repeat([limits.u_min, limits.y_min], h * m) - known
    hessian = matrix.T @ matrix
    found = qpsolvers.solve_qp(
        (hessian + hessian.T) / 2, -matrix.T @ right, np.vstack([rows, -rows]),
        np.concatenate([high, -low]), solver="daqp",
    )  # fmt: skip
    assert found is not None
    return np.asarray(found[:m])


@pytest.mark.parametrize("feedthrough", [0.0, 0.4])
def test_the_first_input_is_that_of_the_whole_programme(feedthrough: float) -> None:
    own = design(feedthrough)
    limits = Limits(-0.6, 0.5, -1.1, 0.9)
    servo, rng, bound = PredictiveServo(own, limits), np.random.default_rng(0), 0
    for _ in range(20):
        r, w, x0 = (
            rng.normal(size=(21, 2)),
            0.1 * rng.normal(size=(20, 1)),
            0.2 * rng.normal(size=3),
        )
        u = servo.step(servo.start(x0), r, w).u
        expected = written_out(own, limits, (np.vstack([r, r[-1:]]), np.vstack([w, w[-1:]])), x0)
        np.testing.assert_allclose(u, expected, atol=2e-6)
        bound += int(
            np.abs(u - PredictiveServo(own, Limits()).step(servo.start(x0), r, w).u).max() > 1e-3
        )
    assert servo.failures == 0
    assert bound > 10


def test_a_polygon_is_the_box_that_it_is_when_turned() -> None:
    """Outputs and polygon turned by half a radian ask for the same inputs as outputs in a box."""
    own, c, s = design(0.4), np.cos(0.5), np.sin(0.5)
    turn = np.array([[c, -s], [s, c]])
    plant = (A, B, turn @ C, 0.4 * turn)
    turned = preview_gains(plant, 1.0, 0.05, 0.3, 20, E=E)
    inside = Limits(-0.6, 0.5, [-1.1, -0.8], [0.9, 0.7])
    corners = np.array([[-1.1, -0.8], [0.9, -0.8], [0.9, 0.7], [-1.1, 0.7]])
    servo = PredictiveServo(own, inside)
    other = PredictiveServo(turned, Limits(-0.6, 0.5, polygons=[corners @ turn.T]))
    rng = np.random.default_rng(1)
    for _ in range(10):
        r, x0 = rng.normal(size=(21, 2)), 0.2 * rng.normal(size=3)
        u = servo.step(servo.start(x0), r).u
        np.testing.assert_allclose(other.step(other.start(x0), r @ turn.T).u, u, atol=1e-6)
    assert servo.failures == other.failures == 0


@pytest.mark.parametrize("feedthrough", [0.0, 0.4])
def test_the_least_input_is_that_of_the_programme_written_out(feedthrough: float) -> None:
    weight = np.array([[0.3, 0.1], [0.1, 0.2]])
    own = preview_gains((A, B, C, feedthrough * np.eye(2)), 1.0, 0.05, weight, 20, E=E)
    servo = LeastInputServo(own, Limits(-0.6, 0.5, 0.1, 0.8))
    rng, first, none = np.random.default_rng(3), 0 if feedthrough else 1, 0
    seen = slice(first, first + 20)
    for _ in range(20):
        w, x0 = 0.05 * rng.normal(size=(20, 1)), 0.2 * rng.normal(size=3)
        free, forced = motion(own.plant, w, x0)
        held = np.eye(40).reshape(20, 2, 40)
        outputs = np.einsum("pn,knu->kpu", C, forced)[seen]
        if feedthrough:
            outputs = outputs + feedthrough * held
        known = (free @ C.T)[seen].ravel()
        rows, big = outputs.reshape(40, 40), np.kron(np.eye(20), weight)
        expected = qpsolvers.solve_qp(
            big, np.zeros(40), np.vstack([rows, -rows]), np.concatenate([0.8 - known, known - 0.1]),
            lb=np.full(40, -0.6), ub=np.full(40, 0.5), solver="daqp",
        )  # fmt: skip
        u = servo.step(servo.start(x0), np.zeros((21, 2)), w).u
        np.testing.assert_allclose(u, [0.0, 0.0] if expected is None else expected[:2], atol=1e-7)
        none += int(expected is None)
    assert servo.failures == none < 16


def test_without_limits_in_reach_it_is_the_preview_servo() -> None:
    own = preview_gains(cart_table(0.814, 0.005), 1.0, 0.0, 1e-6, 320)
    r = np.interp(np.arange(500) * 0.005, [1.0, 1.1], [0.0, 0.1])
    servo, held = PredictiveServo(own, Limits(-1e3, 1e3, -1.0, 1.0)), np.pad(r, (0, 320), "edge")
    state, inputs = servo.start(), []
    for k in range(500):
        state = servo.step(state, held[k : k + 321])
        inputs.append(state.u)
    np.testing.assert_allclose(inputs, track(own, r).u, atol=1e-10)


def test_a_limit_that_cannot_be_kept_is_counted_and_the_input_cut() -> None:
    servo = PredictiveServo(design(), Limits(-0.1, 0.1, -0.2, 0.2))
    state = servo.step(servo.start([50.0, 0.0, 0.0]), np.zeros((21, 2)))
    assert servo.failures == 1
    assert np.abs(state.u).max() <= 0.1


def box(x: float, y: float, length: float = 0.2, width: float = 0.1) -> Array:
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (length / 2, width / 2)
    return half + np.array([x, y])


def test_a_walk_stays_within_its_support_polygons() -> None:
    """Wieber's: 0.1 s samples, steps of 0.25 m in 0.5 s, no reference at all."""
    supports = [box(0.0, 0.0, 0.2, 0.3)] * 10
    for i in range(6):
        supports += [box(0.25 * i, 0.1 * (-1) ** i)] * 5
    supports += [box(1.25, 0.0, 0.2, 0.3)] * 40
    run = zmp_mpc(supports, 0.8, 0.1)
    for k, polygon in enumerate(supports):
        normals, offsets = half_planes(polygon)
        assert (normals @ run.zmp[k] - offsets).max() < 1e-6
    np.testing.assert_allclose(run.zmp, run.com - 0.8 / 9.81 * run.acceleration, atol=1e-14)
    # Nothing asks for rest: in the end the CoM sways over the soles, and no further.
    normals, offsets = half_planes(supports[-1])
    assert (run.com[-20:] @ normals.T < offsets).all()


def test_half_planes_of_a_square_either_way_round() -> None:
    for square in (box(0.0, 0.0, 2.0, 2.0), box(0.0, 0.0, 2.0, 2.0)[::-1]):
        normals, offsets = half_planes(square)
        np.testing.assert_allclose(offsets, 1.0)
        np.testing.assert_allclose(np.abs(normals).sum(axis=1), 1.0)
        assert (normals @ [0.9, -0.9] < offsets).all()
        assert not (normals @ [1.1, 0.0] < offsets).all()


LONG = preview_gains(([[0.9]], [[1.0]], [[1.0]], [[0.0]]), 1.0, 0.0, 0.1, 100_000)
STILL = PredictiveServo(design(), Limits()).start(), np.zeros((21, 2))


def test_refusals() -> None:
    bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]
    for call, argument in (
        (lambda: half_planes(bow), "polygon"),
        (lambda: half_planes([[0.0, 0.0]]), "polygon"),
        (lambda: zmp_mpc([], 0.8, 0.1), "supports"),
        (lambda: zmp_mpc([bow], 0.8, 0.1), "supports"),
        (lambda: PredictiveServo(design(), Limits(y_max=-np.inf)).step(*STILL), "y_max"),
        (lambda: PredictiveServo(design(), Limits(polygons=bow)).step(*STILL), "polygons"),
        (lambda: LeastInputServo(design(), Limits(polygons=[bow])).step(*STILL), "polygons"),
        (lambda: LeastInputServo(LONG, Limits()), "design"),
        (lambda: zmp_mpc(3, 0.8, 0.1), "supports"),  # type: ignore[arg-type]
        (lambda: zmp_mpc([box(0.0, 0.0)], -1.0, 0.1), "z_c"),
        (lambda: zmp_mpc([box(0.0, 0.0)], 0.8, 0.1, 1e9), "preview_time"),
        (lambda: zmp_mpc([box(0.0, 0.0)], 0.8, 0.1, com=(1.0,)), "com"),
        (lambda: PredictiveServo(design(), Limits(u_max="much")), "u_max"),  # type: ignore[arg-type]
    ):
        with pytest.raises(InvalidInput) as caught:
            call()
        assert caught.value.argument == argument
