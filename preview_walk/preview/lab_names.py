"""The walking lab's names for what a preview controller of the cart-table is made of."""

from __future__ import annotations

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.preview.cart_table import natural_frequency
from preview_walk.preview.checks import read_only
from preview_walk.preview.design import PreviewDesign
from preview_walk.types import Array


class LabNames:
    """Matrices and gains of a design by the lab's names; all are read-only.

    Attributes:
        design: the gains and all they were made from.
        z_c: height of the CoM above the ground, m.
    """

    design: PreviewDesign
    z_c: float

    @property
    def A(self) -> Array:
        """(3, 3) of the cart-table x(k+1) = A x(k) + B u(k), x = [c, c', c''], u the jerk."""
        return self.design.plant.A

    @property
    def B(self) -> Array:
        """(3, 1) of the same."""
        return self.design.plant.B

    @property
    def C(self) -> Array:
        """(1, 3) of the ZMP p(k) = C x(k) = c - (z_c / g) c''."""
        return self.design.plant.C

    @property
    def K(self) -> Array:
        """(1, 4) gains of [p - p_ref; the increments of x], which the Riccati equation gives."""
        return read_only(np.hstack((self.design.integral_gain, self.design.state_gain)))

    @property
    def G_preview(self) -> Array:
        """(N,) gains of the reference's increments 1 to N samples ahead."""
        return self.design.preview_gain[:, 0, 0]

    @property
    def omega(self) -> float:
        """Natural frequency sqrt(g / z_c) of the pendulum, 1/s."""
        return natural_frequency(self.z_c)

    @property
    def g(self) -> float:
        """Gravity, m/s²."""
        return GRAVITY
