"""The rectangle under a foot."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.robots.finding.soles import inscribed_rectangle

coordinates = st.floats(-1.0, 1.0).map(lambda x: round(x, 3))
clouds = st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=20, unique=True)


@given(clouds)
def test_the_rectangle_lies_inside_the_hull(points):
    points = np.array(points)
    if np.linalg.matrix_rank(points - points[0], tol=1e-6) < 2:
        return
    from scipy.spatial import ConvexHull

    x0, x1, y0, y1 = inscribed_rectangle(points)
    hull = ConvexHull(points)
    for corner in ((x0, y0), (x0, y1), (x1, y0), (x1, y1)):
        assert (hull.equations[:, :2] @ corner + hull.equations[:, 2] < 1e-9).all()


@given(st.floats(0.01, 1.0), st.floats(0.01, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_a_rectangle_is_found_exactly(length, width, x, y):
    corners = np.array([(x, y), (x + length, y), (x, y + width), (x + length, y + width)])
    found = inscribed_rectangle(corners)
    assert found == pytest.approx((x, x + length, y, y + width), abs=1e-9)


def test_a_disc_holds_the_square_in_it():
    angle = np.linspace(0.0, 2 * np.pi, 400)
    x0, x1, y0, y1 = inscribed_rectangle(np.column_stack((np.cos(angle), np.sin(angle))))
    assert (x1 - x0) * (y1 - y0) == pytest.approx(2.0, rel=2e-3)


def test_a_triangle_holds_half_its_area():
    x0, x1, y0, y1 = inscribed_rectangle(np.array([(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)]))
    assert (x1 - x0) * (y1 - y0) == pytest.approx(0.5, rel=1e-3)


def test_a_line_has_no_width():
    x0, x1, y0, y1 = inscribed_rectangle(np.array([(0.0, 0.0), (0.5, 0.0), (1.0, 0.0)]))
    assert (x0, x1) == (0.0, 1.0)
    assert y0 == y1 == 0.0
