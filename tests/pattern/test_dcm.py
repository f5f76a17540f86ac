"""The DCM: the bounded solution of its unstable equation, and the nearest point of a polygon."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import quad

from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole, nearest_inside, support_margin, support_polygon
from preview_walk.pattern.dcm import dcm_of, planned_dcm
from preview_walk.types import Array

OMEGA, DT = 3.3, 0.005
SOLE = Sole(0.105, 0.065)

metres = st.floats(-1.0, 1.0)
zmps = st.integers(2, 60).flatmap(lambda n: arrays(float, (n, 2), elements=metres))
places = st.builds(pose_at, metres, metres, st.floats(-3.1, 3.1))
polygons = st.lists(places, min_size=1, max_size=2).map(lambda p: support_polygon(p, SOLE))


def density(s: float) -> float:
    return float(OMEGA * np.exp(-OMEGA * s))


@given(zmps)
def test_is_the_integral_of_the_zmp_to_come(zmp: Array) -> None:
    """Quadrature of omega exp(-omega s) p(s), one interval of constant ZMP after the other."""
    dcm = planned_dcm(zmp, OMEGA * DT)
    for k in (0, len(zmp) // 2, len(zmp) - 1):
        total = np.zeros(2)
        for i in range(k, len(zmp)):
            start, end = (i - k) * DT, np.inf if i == len(zmp) - 1 else (i - k + 1) * DT
            total += zmp[i] * quad(density, start, end)[0]
        assert dcm[k] == pytest.approx(total, abs=1e-9)


def test_of_a_swaying_zmp_in_closed_form() -> None:
    """p = cos(a t) has the bounded DCM Re[omega / (omega - i a) exp(i a t)]."""
    a = 4.0
    for dt, tolerance in ((0.01, 4e-2), (0.001, 4e-3), (0.0001, 4e-4)):
        t = np.arange(0.0, 12.0, dt)
        zmp = np.column_stack([np.cos(a * t), np.sin(a * t)])
        exact = OMEGA / (OMEGA - 1j * a) * np.exp(1j * a * t)
        early = t < 6.0  # the ZMP that is held at the end is forgotten by then
        error = planned_dcm(zmp, OMEGA * dt) - np.column_stack([exact.real, exact.imag])
        assert np.abs(error[early]).max() < tolerance


@given(zmps, metres, metres)
def test_moves_with_the_zmp_and_superposes(zmp: Array, dx: float, dy: float) -> None:
    dcm, move = planned_dcm(zmp, OMEGA * DT), np.array((dx, dy))
    assert planned_dcm(zmp + move, OMEGA * DT) == pytest.approx(dcm + move, abs=1e-12)
    assert planned_dcm(2.0 * zmp[:, ::-1], OMEGA * DT) == pytest.approx(2.0 * dcm[:, ::-1])
    assert dcm[-1] == pytest.approx(zmp[-1], abs=1e-15)
    assert (dcm <= zmp.max(axis=0) + 1e-12).all()
    assert (dcm >= zmp.min(axis=0) - 1e-12).all()


@given(zmps)
def test_anything_else_runs_away(zmp: Array) -> None:
    """Played forward the planned DCM ends on the last ZMP; a millimetre beside it is multiplied."""
    grow = np.exp(OMEGA * DT)
    right = planned_dcm(zmp, OMEGA * DT)[0]
    wrong = right + 1e-3
    for p in zmp:
        right, wrong = (p + (dcm - p) * grow for dcm in (right, wrong))
    assert right == pytest.approx(zmp[-1], abs=1e-9)
    assert wrong - right == pytest.approx(np.full(2, 1e-3 * grow ** len(zmp)), rel=1e-6)


@given(polygons, metres, metres)
def test_nearest_inside_is_inside_and_nearest(polygon: Array, x: float, y: float) -> None:
    point = np.array((x, y))
    found, margin = nearest_inside(polygon, point), float(support_margin(polygon, point))
    assert support_margin(polygon, found) >= -1e-12
    assert np.linalg.norm(found - point) == pytest.approx(max(0.0, -margin), abs=1e-12)
    assert nearest_inside(polygon, found) == pytest.approx(found, abs=1e-12)
    # Nothing else on the edge is nearer.
    share = np.linspace(0.0, 1.0, 50)[:, None]
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        distances = np.linalg.norm(a + share * (b - a) - point, axis=1)
        assert (distances >= np.linalg.norm(found - point) - 1e-12).all()


def test_of_a_falling_pendulum_grows_as_it_does() -> None:
    """c = a exp(omega t) + b exp(-omega t) about a ZMP at 0: the DCM is the part that runs away."""
    a, b = np.array([0.01, -0.02]), np.array([0.05, 0.03])
    for t in (0.0, 0.3, 1.0):
        grow, fade = np.exp(OMEGA * t), np.exp(-OMEGA * t)
        com, velocity = a * grow + b * fade, OMEGA * (a * grow - b * fade)
        assert dcm_of(com, velocity, OMEGA) == pytest.approx(2.0 * a * grow)
