"""The plane for arrays against `poses`, which has it for one pose."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.geometry import planar, poses

angles = st.floats(-20.0, 20.0)
places = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3.1, 3.1))


@given(st.lists(angles, min_size=1, max_size=9))
def test_wrapping_is_the_same_for_one_and_for_many(values):
    wrapped = planar.wrap(np.array(values))
    assert wrapped.tolist() == [planar.wrap(value) for value in values]
    assert (wrapped >= -np.pi).all()
    assert (wrapped < np.pi).all()
    assert np.cos(wrapped) == pytest.approx(np.cos(values))
    assert np.sin(wrapped) == pytest.approx(np.sin(values))


@given(st.lists(st.tuples(places, places), min_size=1, max_size=5))
def test_yaw_and_the_yaw_between_two_soles(pairs):
    left = np.array([poses.pose_at(*a) for a, _ in pairs])
    right = np.array([poses.pose_at(*b) for _, b in pairs])
    assert planar.yaw(left) == pytest.approx([poses.yaw_of(pose) for pose in left])
    middle = planar.mid_yaw(left, right)
    for a, b, yaw in zip(left, right, middle, strict=True):
        turn = abs(planar.wrap(poses.yaw_of(a) - poses.yaw_of(b)))
        if turn < np.pi - 1e-6:  # opposite soles have two middles
            assert planar.wrap(yaw - poses.midfeet(a, b)[2]) == pytest.approx(0.0, abs=1e-9)


@given(places, st.floats(-3.0, 3.0))
def test_turning_is_the_rotation_of_a_frame(place, angle):
    x, y, _ = place
    moved = poses.compose((0.0, 0.0, angle), x, y)
    assert planar.turn(np.array([x, y]), angle) == pytest.approx(moved[:2])
    both = planar.turn(np.array([[x, y], [y, x]]), np.array([angle, 0.0]))
    assert both == pytest.approx(np.array([moved[:2], (y, x)]))
