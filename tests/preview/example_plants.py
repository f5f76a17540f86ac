"""Plants on which the tests of the preview servo agree: Kajita's cart-table and a coupled one."""

from __future__ import annotations

import control
import numpy as np

from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains

KAJITA = cart_table(0.814, 0.005)


def kajita(horizon: int = 320) -> PreviewDesign:
    return preview_gains(KAJITA, 1.0, 0.0, 1e-6, horizon)


def two_by_two() -> control.StateSpace:
    """Return a plant of 4 states, 2 inputs, 2 outputs, one mode unstable."""
    rng = np.random.default_rng(7)
    a = np.diag([1.05, 0.9, 0.7, 0.8]) + 0.1 * np.triu(rng.normal(size=(4, 4)), 1)
    return control.ss(a, rng.normal(size=(4, 2)), rng.normal(size=(2, 4)), 0, 0.1)
