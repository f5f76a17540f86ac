"""Gains of the preview servo: identities that hold for every plant, and sentences that refuse."""

import copy
import math
import pickle
import re
from collections.abc import Callable

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preview.example_plants import KAJITA, kajita, two_by_two

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import cart_table, natural_frequency
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains


@pytest.mark.parametrize("design", [kajita(), preview_gains(two_by_two(), 1.0, 0.1, 0.5, 60)])
def test_riccati_and_gain_identities(design: PreviewDesign) -> None:
    system, p = design.system, design.system.noutputs
    n = system.nstates
    phi = np.block([[np.eye(p), system.C @ system.A], [np.zeros((n, p)), system.A]])
    g = np.vstack([system.C @ system.B, system.B])
    q = np.block([[design.Q_e, np.zeros((p, n))], [np.zeros((n, p)), design.Q_x]])
    P = design.riccati
    inner = design.R + g.T @ P @ g
    defect = phi.T @ P @ phi - phi.T @ P @ g @ np.linalg.solve(inner, g.T @ P @ phi) + q - P
    assert np.abs(defect).max() < 1e-11 * np.abs(P).max()
    assert design.residual < 1e-11
    assert np.linalg.eigvalsh(P)[0] > -1e-12 * np.abs(P).max()
    gain = np.hstack([design.integral_gain, design.state_gain])
    np.testing.assert_allclose(design.closed_loop_matrix, phi - g @ gain, rtol=1e-12, atol=1e-12)
    # The integral and the first preview gain act on e and r: opposite signs.
    np.testing.assert_allclose(design.preview_gain[0], -design.integral_gain, rtol=1e-9)
    # Only differences of the reference matter, so the gains on r itself sum to the integral gain.
    np.testing.assert_allclose(design.window_gain.sum(axis=0), design.integral_gain, rtol=1e-9)


def test_gains_decay_with_the_slow_mode() -> None:
    """The cart-table's slow mode is exp(-omega dt), the stable zero of the plant."""
    design = kajita(2000)
    assert design.slow_mode == pytest.approx(math.exp(-natural_frequency(0.814) * 0.005), rel=1e-5)
    assert design.neglected == design.slow_mode**2000
    gains = np.abs(design.preview_gain[:, 0, 0])
    # A nearly double pole: l * slow_mode ** l, whose ratio approaches slow_mode as 1 / l.
    ratio = gains[1000:1800] / gains[999:1799]
    assert np.all(np.abs(ratio - design.slow_mode) < 2.0 / 1000)
    # A pair of complex modes: the envelope decays with their modulus.
    pair = preview_gains(control.ss(0.95, 1.0, 1.0, 0, 0.1), 1.0, 0.0, 10.0, 60)
    modulus = np.abs(np.linalg.eigvals(pair.closed_loop_matrix)).max()
    assert pair.slow_mode == pytest.approx(modulus)
    envelope = np.abs(pair.preview_gain[:, 0, 0]).reshape(2, 30).max(axis=1)
    assert 0.3 < envelope[1] / envelope[0] / modulus**30 < 3.0


def test_a_slow_mode_that_no_gain_contains_asks_for_no_horizon() -> None:
    """A mode of the plant that neither input nor output touches decays by itself."""
    system = control.ss(np.diag([0.5, 0.999]), [[1.0], [0.0]], [[1.0, 0.0]], 0, 0.1)
    design = preview_gains(system, 1.0, 0.0, 0.1, 5)
    assert np.abs(np.linalg.eigvals(design.closed_loop_matrix)).max() == pytest.approx(0.999)
    assert design.slow_mode < 0.5


def test_kajitas_parameters_give_kajitas_gains() -> None:
    """The gains printed by a direct evaluation of the formulas; see `preview_gains`."""
    design = kajita()
    assert design.integral_gain.item() == pytest.approx(618.70, rel=1e-4)
    np.testing.assert_allclose(design.state_gain[0], [72719.4, 21549.6, 177.013], rtol=1e-4)
    assert design.preview_gain.shape == (320, 1, 1)
    assert np.argmin(design.preview_gain) == 5


@given(z_c=st.floats(0.25, 1.5), dt=st.floats(1e-3, 0.02), r=st.floats(-8.0, -3.0))
@settings(max_examples=25)
def test_any_walking_cart_table_can_be_designed(z_c: float, dt: float, r: float) -> None:
    horizon = math.ceil(6.0 / natural_frequency(z_c) / dt)
    design = preview_gains(cart_table(z_c, dt), 1.0, 0.0, 10.0**r, horizon)
    assert design.residual < 1e-9
    np.testing.assert_allclose(design.preview_gain[0], -design.integral_gain, rtol=1e-6)


def test_closed_loop_has_the_poles_of_the_design_and_follows_constants() -> None:
    design = preview_gains(two_by_two(), 1.0, 0.1, 0.5, 60)
    loop = design.closed_loop
    poles = np.linalg.eigvals(design.closed_loop_matrix)
    np.testing.assert_allclose(np.sort_complex(loop.poles()), np.sort_complex(poles), atol=1e-10)
    np.testing.assert_allclose(loop.dcgain() @ design.integral_gain, np.eye(2), atol=1e-9)
    assert loop.dt == design.dt == 0.1


@pytest.mark.parametrize(
    "copied", [lambda x: x, lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy]
)
def test_arrays_cannot_be_changed(copied: Callable[[PreviewDesign], PreviewDesign]) -> None:
    """Nor those of a pickled or deep-copied design, which is the same design."""
    design = copied(kajita())
    np.testing.assert_array_equal(design.feedback, kajita().feedback)
    assert repr(design) == (
        "PreviewDesign(Plant(cart_table: 3 states, 1 inputs, 1 outputs, 0 disturbances, "
        "dt = 0.005), N = 320, with integral action)"
    )
    for array in (design.preview_gain, design.riccati, design.R, design.window_gain):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0.0


def refused(sentence: str) -> pytest.RaisesExc[InvalidInput]:
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


A, B, C = KAJITA.A, KAJITA.B, KAJITA.C


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            (A,),
            "expected a control.StateSpace, got a ndarray; a TransferFunction or (A, B, C, D) is "
            "allowed too.",
        ),
        (
            (cart_table(0.814),),
            "expected a discrete-time system with a sampling time in seconds, got dt = 0; the "
            "argument dt discretises a continuous-time one, as control.c2d(system, dt) does.",
        ),
        (
            (control.ss(A * np.nan, B, C, 0, 0.1),),
            "expected finite system matrices, got NaN or infinity in A, B, C or D.",
        ),
        (
            (KAJITA, np.eye(2)),
            "expected Q_e to be a scalar or of shape (1,) or (1, 1), got shape (2, 2).",
        ),
        (
            (KAJITA, 1.0, np.ones(4)),
            "expected Q_x to be a scalar or of shape (3,) or (3, 3), got shape (4,).",
        ),
        ((KAJITA, 1.0, 0.0, np.nan), "expected R to be finite, got NaN or infinity."),
        (
            (KAJITA, 1.0, np.triu(np.ones((3, 3)))),
            "expected Q_x to be symmetric, got an asymmetric matrix.",
        ),
        (
            (KAJITA, 1.0, np.diag([1.0, -2.0, 0.0])),
            "expected Q_x to be positive semidefinite, got a smallest eigenvalue of -2.",
        ),
        (
            (KAJITA, 1.0, 0.0, 0.0),
            "expected R to be positive definite, got a smallest eigenvalue of 0.",
        ),
        (
            (KAJITA, 1.0, 0.0, 1e-6, 1.5),
            "expected the horizon N to be a whole number of samples >= 0 or math.inf, got 1.5.",
        ),
        (
            (KAJITA, 1.0, 0.0, 1e-6, -1),
            "expected the horizon N to be a whole number of samples >= 0 or math.inf, got -1.",
        ),
        (
            (KAJITA, 1.0, 0.0, 1e-6, 10**9),
            "expected the horizon N to be at most 1000000 samples, got 1000000000.",
        ),
        (
            (control.ss(np.diag([1.2, 0.5]), [[0.0], [1.0]], [[1.0, 1.0]], 0, 0.1),),
            "expected a stabilisable system, got a mode at z = 1.2 that the input does not reach.",
        ),
        (
            (control.ss([[1.0, 0.1], [0.0, 0.9]], [[0.0], [0.1]], [[0.0, 1.0]], 0, 0.1), [[0.0]]),
            "expected weights Q_e and Q_x that make the system detectable, got a mode at z = 1 "
            "that they do not see.",
        ),
        (
            (control.ss(np.diag([0.5, 0.6]), np.eye(2), [[1.0, 1.0], [2.0, 2.0]], 0, 0.1),),
            "expected outputs that can all be held at any constant value, got 2 outputs and 2 "
            "inputs with [A - I, B; C, D] not of full row rank: a zero at z = 1, dependent "
            "outputs or too few inputs.",
        ),
        (
            (control.ss(np.diag([1.2, 0.5]), [[1.0], [1.0]], [[0.0, 1.0]], 0, 0.1),),
            "expected weights Q_e and Q_x that make the system detectable, got a mode at z = 1.2 "
            "that they do not see.",
        ),
        (
            (KAJITA, 0.0),
            "expected weights Q_e and Q_x that make the system detectable, got a mode at z = 1 "
            "that they do not see.",
        ),
    ],
)
def test_refusals(arguments: tuple[object, ...], sentence: str) -> None:
    defaults = (KAJITA, 1.0, 0.0, 1e-6, 320)
    with refused(sentence):
        preview_gains(*arguments, *defaults[len(arguments) :])  # type: ignore[arg-type]
