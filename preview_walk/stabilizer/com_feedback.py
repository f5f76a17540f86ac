"""CoM feedback: from measured state, reference, disturbance and soles to a wanted ZMP.

With the DCM xi = c + c' / omega and the cart-table's c'' = omega^2 (c - p), a ZMP of

    p = p_ref + (1 + k / omega) (xi - xi_ref) + d / omega

gives the error e = c - c_ref the dynamics e'' = -(omega + k) e' - omega k e, with poles at -omega
and at -k (Sugihara, ICRA 2009; Englsberger, Ott and Albu-Schaeffer, T-RO 2015). The
disturbance d, by which the DCM runs besides omega (xi - p), is opposed as it is observed, before an
error has grown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preview_walk.geometry.support import Sole, within_support
from preview_walk.pattern.walking_pattern import ComReference
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class CentroidalState:
    """The measured motion of the CoM, in the world.

    Attributes:
        com: (3,) position, m.
        velocity: (3,) m/s.
    """

    com: Array
    velocity: Array

    def dcm(self, omega: float) -> Array:
        """Return the DCM (2,), m, of a pendulum of natural frequency `omega` (1/s)."""
        value: Array = (self.com + self.velocity / omega)[:2]
        return value


@dataclass(frozen=True)
class FeedbackGains:
    """Rates of the feedback.

    Attributes:
        omega: natural frequency of the pendulum, 1/s.
        dcm: rate k at which an error of the DCM decays, 1/s.
        height: natural frequency of the CoM's height, critically damped, rad/s.
    """

    omega: float
    dcm: float
    height: float


@dataclass(frozen=True, eq=False)
class Support:
    """What bears the robot.

    Attributes:
        soles: poses (4, 4) of the soles in contact, world, m; none in flight.
        sole: half sizes of a sole: where contact forces can put the ZMP.
        reach: half sizes within which the feedback may ask for it. What the soles cannot give,
            trunk and arms do by their angular momentum.
    """

    soles: Sequence[Array]
    sole: Sole
    reach: Sole


@dataclass(frozen=True, eq=False)
class ComFeedback:
    """What the feedback asks for.

    Attributes:
        acceleration: (3,) of the CoM, world, m/s^2.
        zmp: (2,) the cart-table's ZMP that goes with it, m.
        sole_zmp: (2,) the nearest to it that the soles alone can give, m: what drives the DCM.
    """

    acceleration: Array
    zmp: Array
    sole_zmp: Array


def com_feedback(
    state: CentroidalState,
    reference: ComReference,
    disturbance: Array,
    support: Support,
    gains: FeedbackGains,
) -> ComFeedback:
    """Return the ZMP and the CoM acceleration that lead the CoM back to its reference.

    Args:
        state: measured.
        reference: of this instant.
        disturbance: (2,) rate at which the DCM runs besides omega (xi - p), world, m/s.
        support: the soles; without any the wanted ZMP is not bounded.
        gains: rates of the feedback.
    """
    omega = gains.omega
    com, velocity = state.com[:2], state.velocity[:2]
    error = reference.com - state.com
    rate = reference.velocity - state.velocity
    # The reference's accelerations are a cart-table's, so its feedback is one around their ZMP.
    cart = reference.com[:2] - reference.acceleration[:2] / omega**2
    away = (com + velocity / omega) - (reference.com + reference.velocity / omega)[:2]
    zmp = sole_zmp = cart + (1.0 + gains.dcm / omega) * away + disturbance / omega
    # What the swinging leg's momentum adds to the cart-table's ZMP must fit on the soles too.
    shift = reference.zmp - cart
    if support.soles:
        sole_zmp = within_support(zmp + shift, support.soles, support.sole) - shift
        zmp = within_support(zmp + shift, support.soles, support.reach) - shift
    acceleration = np.zeros(3)
    acceleration[:2] = omega**2 * (com - zmp)
    h = gains.height
    acceleration[2] = reference.acceleration[2] + 2.0 * h * rate[2] + h * h * error[2]
    return ComFeedback(acceleration, zmp, sole_zmp)
