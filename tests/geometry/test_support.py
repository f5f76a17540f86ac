"""Sole rectangles, support polygons, signed margins."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import heading_of, pose_at
from preview_walk.geometry.support import Sole, sole_gap, support_margin, support_polygon

SOLE = Sole(0.1, 0.05)
near = st.floats(-0.4, 0.4)
yaw = st.floats(-3.1, 3.1)
tilt = st.floats(-0.5, 0.5)
poses = st.builds(pose_at, near, near, yaw, near, tilt, tilt)


@given(st.lists(poses, min_size=1, max_size=2))
def test_the_polygon_is_the_convex_hull(soles):
    polygon = support_polygon(soles, SOLE)
    corners = np.vstack([SOLE.corners(p)[:, :2] for p in soles])
    hull = ConvexHull(corners)
    x, y = polygon.T
    area = 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
    assert area == pytest.approx(hull.volume, abs=1e-9)
    assert support_margin(polygon, corners).min() > -1e-9


@given(poses, near, near)
def test_the_margin_is_the_distance_to_the_rectangle(pose, x, y):
    level = pose_at(*heading_of(pose))
    point = (level @ [x, y, 0.0, 1.0])[:2]
    margin = float(support_margin(support_polygon([level], SOLE), point))
    inside = min(0.1 - abs(x), 0.05 - abs(y))
    outside = np.hypot(max(abs(x) - 0.1, 0.0), max(abs(y) - 0.05, 0.0))
    assert margin == pytest.approx(inside if inside >= 0.0 else -outside, abs=1e-9)


def test_margins_of_many_points_at_once():
    polygon = support_polygon([np.eye(4)], SOLE)
    points = np.array([[0.0, 0.0], [0.1, 0.0], [0.13, 0.09]])
    assert support_margin(polygon, points) == pytest.approx([0.05, 0.0, -0.05])
    assert support_margin(polygon, points[2]).shape == ()


def test_a_sloped_sole_supports_less_ground():
    steep = support_polygon([pose_at(0.0, 0.0, pitch=1.0)], SOLE)
    assert np.ptp(steep[:, 0]) == pytest.approx(0.2 * np.cos(1.0))


@given(st.tuples(near, near, yaw), st.tuples(near, near, yaw))
def test_the_gap_tells_whether_soles_overlap(a, b):
    gap = sole_gap(a, b, SOLE)
    assert gap == pytest.approx(sole_gap(b, a, SOLE), abs=1e-12)
    # Points of one sole against the other rectangle: a dense sample decides.
    u, v = np.meshgrid(np.linspace(-0.1, 0.1, 41), np.linspace(-0.05, 0.05, 41))
    grid = np.stack([u.ravel(), v.ravel(), 0 * u.ravel(), 1 + 0 * u.ravel()])
    points = (pose_at(*b) @ grid)[:2].T
    margin = support_margin(support_polygon([pose_at(*a)], SOLE), points)
    if gap > 1e-9:
        assert margin.max() < 0.0
        assert gap <= -margin.max() + 1e-9
    if gap < -0.008:
        assert margin.max() > 0.0


def test_parallel_soles_have_the_plain_gap():
    assert sole_gap((0.0, 0.0, 0.3), (0.0, 0.0, 0.3), SOLE) == pytest.approx(-0.1)
    assert sole_gap((0.0, 0.1, 0.0), (0.05, -0.1, 0.0), SOLE) == pytest.approx(0.1)
    assert sole_gap((0.0, 0.1, 0.0), (0.0, 0.04, 0.0), SOLE) == pytest.approx(-0.04)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Sole(0.0, 0.1), "half_length must be > 0 m, got 0.0."),
        (lambda: Sole(0.1, np.nan), "half_width must be > 0 m, got nan."),
        (
            lambda: support_polygon([], SOLE),
            "a support polygon needs at least one standing sole, got none.",
        ),
    ],
)
def test_what_cannot_be_is_refused(make, sentence):
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        make()
