"""The servo as systems of `control`: the same motion as `track`, however they are put together."""

import control
import numpy as np
import pytest

from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.response import track
from preview_walk.preview.systems import closed_loop_system, preview_filter, servo_system
from preview_walk.types import Array

LENGTH = 80


def plant(feedthrough: float) -> control.StateSpace:
    rng = np.random.default_rng(3)
    a = np.diag([1.02, 0.9, 0.7]) + 0.1 * np.triu(rng.normal(size=(3, 3)), 1)
    return control.ss(
        a, rng.normal(size=(3, 2)), rng.normal(size=(2, 3)), feedthrough * np.eye(2), 0.1,
        states=["a", "b", "c"], inputs=["left", "right"], outputs=["up", "down"],
    )  # fmt: skip


@pytest.fixture(
    params=[
        (n, i, d, e) for n in (0, 1, 12) for i in (True, False) for d in (0.0, 0.3) for e in (0, 2)
    ]
)
def design(request: pytest.FixtureRequest) -> PreviewDesign:
    n, integral, feedthrough, disturbances = request.param
    e = np.arange(3.0 * disturbances).reshape(3, -1) / 5 if disturbances else None
    return preview_gains(plant(feedthrough), 1.0, 0.1, 0.3, n, E=e, integral=integral)


pytestmark = pytest.mark.filterwarnings(
    "ignore::preview_walk.preview.horizon.ShortHorizonWarning", "ignore:connect:UserWarning"
)


def signals(design: PreviewDesign) -> tuple[Array, Array, Array]:
    """Return r, w and the systems' inputs: the future, N samples early, zero before it begins."""
    rng, n = np.random.default_rng(8), design.horizon
    r, w = rng.normal(size=(LENGTH, 2)), rng.normal(size=(LENGTH, design.plant.E.shape[1]))
    late = np.vstack([np.zeros((n, 2)), r])
    w_late = np.vstack([np.zeros((n, w.shape[1])), w])
    ahead = np.vstack([late[n:], np.repeat(late[-1:], n, axis=0)])
    shift = max(0, n - 1)
    w_ahead = np.vstack([w_late[shift:], np.repeat(w_late[-1:], shift, axis=0)])
    return late, w_late, np.hstack([ahead, w_ahead])


def test_the_closed_loop_is_the_tracking(design: PreviewDesign) -> None:
    r, w, ahead = signals(design)
    n = design.horizon
    # A reference that was zero before the run: the filter starts empty, N samples early.
    early = np.vstack([np.zeros((n, ahead.shape[1])), ahead])
    system = closed_loop_system(design)
    response = control.forced_response(system, inputs=early.T)
    expected = track(
        design, np.vstack([np.zeros((n, 2)), r]),
        disturbance=np.vstack([np.zeros((n, w.shape[1])), w]) if w.shape[1] else None,
    )  # fmt: skip
    rows = dict(zip(system.output_labels, response.outputs, strict=True))
    np.testing.assert_allclose(np.stack([rows["up"], rows["down"]], 1), expected.y, atol=1e-10)
    np.testing.assert_allclose(np.stack([rows["left"], rows["right"]], 1), expected.u, atol=1e-10)
    np.testing.assert_allclose(
        np.stack([rows["up_error"], rows["down_error"]], 1), expected.error, atol=1e-10
    )


def test_the_controller_on_a_plant_of_ones_own(design: PreviewDesign) -> None:
    """`interconnect` by names: the plant with its states as outputs, and the servo."""
    own, q = design.plant, design.plant.E.shape[1]
    measured = control.StateSpace(
        own.A, np.hstack([own.B, own.E]), np.eye(3), np.zeros((3, 2 + q)), 0.1,
        inputs=[*own.inputs, *own.disturbances], outputs=list(own.states), name="measured",
    )  # fmt: skip
    servo = servo_system(design)
    futures = servo.input_labels[3:]
    # The plant's own disturbance comes when the line of delays has brought it.
    both = control.interconnect(
        [measured, servo],
        inputs=[*futures, *own.disturbances],
        outputs=[*own.states, *own.inputs],
    )
    r, w, ahead = signals(design)
    n = design.horizon
    zero = np.zeros((n, 2 + q))
    inputs = np.hstack([np.vstack([zero, ahead]), np.vstack([zero[:, 2:], w])])
    response = control.forced_response(both, inputs=inputs.T)
    expected = track(
        design, np.vstack([zero[:, :2], r]),
        disturbance=np.vstack([zero[:, 2:], w]) if q else None,
    )  # fmt: skip
    np.testing.assert_allclose(response.outputs[:3].T, expected.x, atol=1e-10)
    np.testing.assert_allclose(response.outputs[3:].T, expected.u, atol=1e-10)


def test_the_filter_is_finite_and_named() -> None:
    design = preview_gains(cart_table(0.814, 0.005), 1.0, 0.0, 1e-6, 320)
    fir = preview_filter(design)
    assert fir.nstates == 320
    assert np.abs(fir.poles()).max() == 0.0
    assert (fir.input_labels, fir.output_labels) == (["zmp_ahead"], ["w[0]", "zmp_reference"])
    impulse = control.forced_response(fir, inputs=np.eye(1, 330)[0]).outputs
    np.testing.assert_allclose(impulse[0, :320], design.window_gain[::-1, 0, 0], rtol=1e-12)
    # Filter and loop joined by name: the CoM's ZMP follows a constant reference.
    whole = control.interconnect([fir, design.closed_loop], inputs=["zmp_ahead"], outputs=["zmp"])
    assert whole.dcgain() == pytest.approx(1.0, abs=1e-6)
