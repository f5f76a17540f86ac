"""Poses, headings and angles."""

import re
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.geometry import poses as p

angle = st.floats(-3.1, 3.1)
metre = st.floats(-50.0, 50.0)
heading = st.tuples(metre, metre, angle)


@given(metre, metre, angle, metre, st.floats(-1.5, 1.5), angle)
def test_angles_of_a_pose_are_those_it_was_made_of(x, y, yaw, z, pitch, roll):
    pose = p.pose_at(x, y, yaw, z, pitch, roll)
    assert np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
    assert p.rpy_of(pose) == pytest.approx((roll, pitch, yaw), abs=1e-9)
    assert p.as_pose(pose, "pose") is pose


@given(heading, heading)
def test_relative_undoes_compose(frame, move):
    assert p.relative(frame, p.compose(frame, *move)) == pytest.approx(move, abs=1e-9)


@given(st.floats(-1e3, 1e3))
def test_wrap_keeps_the_direction(a):
    assert -pi <= p.wrap(a) < pi
    assert np.cos(p.wrap(a)) == pytest.approx(np.cos(a), abs=1e-9)


def test_midfeet_takes_the_short_way_round():
    left, right = p.pose_at(0.0, 0.2, 3.1), p.pose_at(0.0, 0.0, -3.1)
    x, y, yaw = p.midfeet(left, right)
    assert (x, y) == (0.0, 0.1)
    assert np.cos(yaw) == pytest.approx(-1.0)


@pytest.mark.parametrize(
    ("value", "came"),
    [
        (np.eye(3), "an array of shape (3, 3)"),
        ("here", "'here'"),
        (None, "None"),
    ],
)
def test_what_is_no_pose_is_named(value, came):
    sentence = (
        "sole must be a finite (4, 4) homogeneous pose with an orthonormal right-handed rotation, "
        f"got {came}."
    )
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        p.as_pose(value, "sole")


@pytest.mark.parametrize(
    "change",
    [{(0, 0): 2.0}, {(2, 2): -1.0}, {(0, 3): np.nan}, {(1, 3): np.inf}, {(3, 0): 1.0}],
)
def test_a_matrix_that_moves_no_rigid_body_is_refused(change):
    matrix = np.eye(4)
    for index, value in change.items():
        matrix[index] = value
    with pytest.raises(InvalidInput, match=r"^sole must be a finite \(4, 4\)"):
        p.as_pose(matrix, "sole")


@pytest.mark.parametrize("value", [(1.0,), (1.0, 2.0, 3.0, 4.0), (0.0, np.nan), "ab", 3.0])
def test_what_is_no_heading_is_named(value):
    sentence = f"start must be (x, y) or (x, y, yaw) in m and rad, got {value!r}."
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        p.as_heading(value, "start")
