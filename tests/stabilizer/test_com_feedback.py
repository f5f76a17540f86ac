"""CoM feedback: the law by hand, its poles by simulation, and the bounds of the soles."""

from __future__ import annotations

import numpy as np
import pytest

from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.pattern.walking_pattern import ComReference
from preview_walk.stabilizer.com_feedback import (
    CentroidalState,
    FeedbackGains,
    Support,
    com_feedback,
)
from preview_walk.types import Array

OMEGA, DCM, HEIGHT = 3.0, 20.0, 10.0
GAINS = FeedbackGains(OMEGA, DCM, HEIGHT)
SOLE = Sole(0.1, 0.06)
NONE = np.zeros(2)
FREE = Support([], SOLE, SOLE)


def reference(com: Array | None = None, acceleration: Array | None = None) -> ComReference:
    """Return a reference at rest, its ZMP that of a cart-table."""
    com = np.zeros(3) if com is None else com
    acceleration = np.zeros(3) if acceleration is None else acceleration
    zmp = com[:2] - acceleration[:2] / OMEGA**2
    return ComReference(com, np.zeros(3), acceleration, zmp, zmp, com[:2].copy(), 0.0)


def on_soles(reach: Sole = SOLE) -> Support:
    return Support([pose_at(0.0, 0.1), pose_at(0.0, -0.1)], SOLE, reach)


def test_on_its_reference_the_com_moves_as_the_reference_does() -> None:
    wanted = reference(np.array((0.02, 0.03, 0.8)), np.array((0.3, -0.2, 0.1)))
    state = CentroidalState(wanted.com, np.zeros(3))
    answer = com_feedback(state, wanted, NONE, FREE, GAINS)
    assert answer.acceleration == pytest.approx(wanted.acceleration, abs=1e-12)
    assert answer.zmp == pytest.approx(wanted.zmp, abs=1e-12)


def test_the_zmp_wanted_by_hand() -> None:
    """A DCM 10 mm ahead asks for (1 + k / omega) times that: 20 / 3 + 1 = 7.667 times 10 mm."""
    state = CentroidalState(np.array((0.01, 0.0, 0.0)), np.zeros(3))
    answer = com_feedback(state, reference(), NONE, FREE, GAINS)
    assert answer.zmp == pytest.approx((0.0766667, 0.0), abs=1e-6)
    assert answer.acceleration[0] == pytest.approx(9.0 * (0.01 - 0.0766667), abs=1e-5)


def test_a_disturbance_is_opposed_before_an_error_has_grown() -> None:
    """xi' = omega (xi - p) + d is zero at xi = 0 for p = d / omega."""
    state = CentroidalState(np.zeros(3), np.zeros(3))
    answer = com_feedback(state, reference(), np.array((0.06, -0.03)), FREE, GAINS)
    assert answer.zmp == pytest.approx((0.02, -0.01), abs=1e-12)


def test_an_error_decays_at_the_rates_that_were_asked_for() -> None:
    """The closed loop e'' = a_c e + a_v e' has its poles at -omega and at -k."""

    def acceleration(com: float, velocity: float) -> float:
        state = CentroidalState(np.array((com, 0.0, 0.0)), np.array((velocity, 0.0, 0.0)))
        return float(com_feedback(state, reference(), NONE, FREE, GAINS).acceleration[0])

    loop = np.array(((0.0, 1.0), (acceleration(1.0, 0.0), acceleration(0.0, 1.0))))
    assert sorted(np.linalg.eigvals(loop).real) == pytest.approx([-DCM, -OMEGA])


def test_the_height_is_a_critically_damped_spring() -> None:
    state = CentroidalState(np.array((0.0, 0.0, 0.78)), np.array((0.0, 0.0, 0.05)))
    wanted = reference(np.array((0.0, 0.0, 0.8)))
    answer = com_feedback(state, wanted, NONE, FREE, GAINS)
    assert answer.acceleration[2] == pytest.approx(100.0 * 0.02 - 20.0 * 0.05, abs=1e-12)


def test_what_the_soles_cannot_give_is_not_asked_of_them() -> None:
    """A DCM far ahead: contact forces up to the toes, trunk and arms up to the reach beyond."""
    state = CentroidalState(np.array((0.1, 0.0, 0.0)), np.zeros(3))
    answer = com_feedback(state, reference(), NONE, on_soles(Sole(0.18, 0.14)), GAINS)
    assert answer.sole_zmp == pytest.approx((SOLE.half_length, 0.0), abs=1e-12)
    assert answer.zmp == pytest.approx((0.18, 0.0), abs=1e-12)


def test_the_swinging_legs_share_must_fit_on_the_soles_too() -> None:
    """A ZMP 30 mm ahead of its cart-table's leaves 30 mm less before the toe."""
    plain = reference()
    shifted = ComReference(
        plain.com,
        plain.velocity,
        plain.acceleration,
        plain.zmp + np.array((0.03, 0.0)),
        plain.zmp_ref,
        plain.dcm,
        0.0,
    )
    state = CentroidalState(np.array((0.1, 0.0, 0.0)), np.zeros(3))
    answer = com_feedback(state, shifted, NONE, on_soles(), GAINS)
    assert answer.sole_zmp == pytest.approx((SOLE.half_length - 0.03, 0.0), abs=1e-12)


def test_the_law_is_the_same_in_every_frame() -> None:
    turn = pose_at(0.0, 0.0, 0.7)[:3, :3]
    com, velocity = np.array((0.03, -0.02, 0.79)), np.array((0.1, 0.05, -0.02))
    wanted = reference(np.array((0.0, 0.0, 0.8)), np.array((0.2, 0.1, 0.0)))
    turned = ComReference(
        turn @ wanted.com,
        turn @ wanted.velocity,
        turn @ wanted.acceleration,
        turn[:2, :2] @ wanted.zmp,
        turn[:2, :2] @ wanted.zmp_ref,
        turn[:2, :2] @ wanted.dcm,
        0.0,
    )
    push = np.array((0.05, 0.02))
    here = com_feedback(CentroidalState(com, velocity), wanted, push, FREE, GAINS)
    there = com_feedback(
        CentroidalState(turn @ com, turn @ velocity), turned, turn[:2, :2] @ push, FREE, GAINS
    )
    assert there.acceleration == pytest.approx(turn @ here.acceleration, abs=1e-12)
