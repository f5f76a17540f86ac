"""The divergent component of motion (DCM), xi = c + c' / omega: what decides whether one falls."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dtbtrs

from preview_walk.types import Array


def dcm_of(com: Array, velocity: Array, omega: float) -> Array:
    """Return the DCM (m) of a CoM that moves, axis by axis (Takenaka et al. 2009).

    Args:
        com: position, any shape, m.
        velocity: the same shape, m/s.
        omega: natural frequency of the pendulum, 1/s.
    """
    return com + velocity / omega


def planned_dcm(zmp: Array, omega_dt: float) -> Array:
    """Return the DCM (N, 2) in m that goes with a sampled ZMP.

    xi(t) = omega * integral from t of exp(-omega (s - t)) p(s) ds: the one bounded solution of
    xi' = omega (xi - p) (Englsberger et al. 2015, backwards in time), with the ZMP constant
    over each sample and held after the last.

    Args:
        zmp: (N, 2), m, equally spaced in time.
        omega_dt: natural frequency of the pendulum times the sample time.
    """
    # xi(k) - a xi(k+1) = (1 - a) p(k), a = exp(-omega dt), is upper bidiagonal. (A filter of
    # scipy.signal is as fast, but that package takes half a second to import.)
    decay = float(np.exp(-omega_dt))
    bands = np.ones((2, len(zmp)), order="F")
    bands[0] = -decay
    given = np.asfortranarray((1.0 - decay) * zmp)
    given[-1] = zmp[-1]
    dcm: Array = dtbtrs(bands, given, overwrite_b=True)[0]
    return dcm
