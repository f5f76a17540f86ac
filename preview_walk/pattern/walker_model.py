"""What the walking pattern knows of a robot: legs, soles, the momentum and height of its swings."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.constants import GRAVITY
from preview_walk.geometry.support import Sole
from preview_walk.pattern.com_height import LegGeometry
from preview_walk.pattern.swing_moment import MomentumModel


@dataclass(frozen=True, eq=False)
class WalkerModel:
    """A robot as the walking pattern sees it.

    Attributes:
        legs: how high the CoM can be.
        sole: half sizes of the soles.
        momentum: angular momentum of the swinging legs.
        swing_height: of the apex of a swing, m.
    """

    legs: LegGeometry
    sole: Sole
    momentum: MomentumModel
    swing_height: float

    @property
    def pendulum_height(self) -> float:
        """Height (m) of the cart-table, the CoM's own angular momentum included."""
        return self.momentum.effective_height(self.legs.com_height)

    @property
    def omega(self) -> float:
        """Natural frequency (1/s) of the pendulum, sqrt(g / height) of the cart-table's height."""
        return float((GRAVITY / self.pendulum_height) ** 0.5)
