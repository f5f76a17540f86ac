"""What soles feel: planes by geometry, and a sole that turns about the edge it stands on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preview_walk.controller.feeling import (
    AS_PLANNED,
    CONFORM_RATE,
    TRUST,
    conforming,
    felt_planes,
)
from preview_walk.controller.feet import FootState
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Plane

SOLE = Sole(0.1, 0.05)
STANDS = FootState(True, True, 0.0, 0.0, None)
SWINGS = replace(STANDS, contact=False, felt=False)
SOLES = {"left": pose_at(0.3, 0.1, 0.2, 0.05, -0.1, 0.06), "right": pose_at(0.0, -0.1)}


def test_a_touch_tells_the_height_and_keeps_the_tilt() -> None:
    plane = Plane(0.0, 0.1, -0.05)
    before, now = {"left": SWINGS, "right": STANDS}, {"left": STANDS, "right": STANDS}
    ((foot, felt),) = felt_planes(before, now, SOLES, plane)
    assert foot == "left"
    assert (felt.ahead, felt.left) == pytest.approx((0.1, -0.05))
    assert felt.height(0.3, 0.1) == pytest.approx(0.05)


def test_a_foot_that_comes_to_stand_alone_tells_the_tilt() -> None:
    before, now = {"left": STANDS, "right": STANDS}, {"left": STANDS, "right": SWINGS}
    ((foot, felt),) = felt_planes(before, now, SOLES, Plane())
    assert foot == "left"
    sole = Plane.through(SOLES["left"][:3, 3], SOLES["left"][:3, 2])
    assert (felt.ahead, felt.left) == pytest.approx((TRUST * sole.ahead, TRUST * sole.left))
    assert felt.height(0.3, 0.1) == pytest.approx(0.05)


def test_feet_that_stand_tell_nothing() -> None:
    both = {"left": STANDS, "right": STANDS}
    assert not list(felt_planes(both, both, SOLES, Plane()))


def wrench(x: float, y: float, rotation: np.ndarray) -> np.ndarray:
    """Return the world wrench about the sole's centre of 100 N at (x, y) of the sole."""
    force = rotation @ (0.0, 0.0, 100.0)
    return np.concatenate([force, np.cross(rotation @ (x, y, 0.0), force)])


@pytest.mark.parametrize("edge", [(0.1, 0.0), (-0.1, 0.0), (0.0, 0.05), (0.0, -0.05), (0.1, 0.05)])
def test_a_sole_turns_about_its_edge_towards_the_ground(edge: tuple[float, float]) -> None:
    """The edge keeps its place, the opposite one goes down."""
    rotation = pose_at(0.0, 0.0, 0.7, 0.0, 0.1, -0.05)[:3, :3]
    here, middle = wrench(*edge, rotation), wrench(0.0, 0.0, rotation)
    twist = conforming(here, middle, rotation, SOLE)
    assert twist is not None
    at_edge = twist[:3] + np.cross(twist[3:], (*edge, 0.0))
    opposite = twist[:3] + np.cross(twist[3:], (-edge[0], -edge[1], 0.0))
    assert at_edge == pytest.approx(np.zeros(3), abs=1e-12)
    assert opposite[2] < -0.1
    assert np.abs(twist[3:]).max() == pytest.approx(CONFORM_RATE * (1.0 - AS_PLANNED))


def test_a_sole_pressed_where_it_should_be_stays() -> None:
    """At an edge too, where the load is meant to be there."""
    for planned, pressed in ((0.0, 0.03), (0.09, 0.1), (-0.08, -0.1)):
        here, wanted = wrench(pressed, 0.0, np.eye(3)), wrench(planned, 0.0, np.eye(3))
        assert conforming(here, wanted, np.eye(3), SOLE) is None
    assert conforming(0.01 * wrench(0.1, 0.0, np.eye(3)), wanted, np.eye(3), SOLE) is None
