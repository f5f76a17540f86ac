"""Slabs: height and normal by plane geometry, and the highest one wins."""

from __future__ import annotations

from math import cos, radians, sin, tan

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.terrain.shapes import stairs
from preview_walk.terrain.slabs import Slab, SlabGround


def test_a_tilted_slab_is_a_plane() -> None:
    """Every point of its upper face, by its pose, is at the ground's height there."""
    slab = Slab(1.0, -0.5, 0.3, 0.6, 0.4, yaw=0.7, pitch=-0.2, roll=0.1)
    ground = SlabGround((slab,), -1.0)
    random = np.random.default_rng(0)
    local = np.zeros((4, 200))
    local[:2], local[3] = random.uniform(-0.3, 0.3, (2, 200)), 1.0
    world = slab.pose @ local
    assert ground.height(world[0], world[1]) == pytest.approx(world[2], abs=1e-12)
    assert ground.normal(1.0, -0.5) == pytest.approx(slab.pose[:3, 2], abs=1e-12)


def test_the_highest_slab_wins_and_beside_them_is_the_floor() -> None:
    ground = SlabGround((Slab(0.0, 0.0, 0.1, 1.0, 1.0), Slab(0.5, 0.0, 0.3, 0.2, 0.2)), -0.4)
    assert ground.height([0.0, 0.5, 0.69, 0.71, 2.0], [0.0] * 5) == pytest.approx(
        [0.1, 0.3, 0.3, 0.1, -0.4]
    )
    assert ground.normal(2.0, 0.0) == pytest.approx((0.0, 0.0, 1.0))
    assert ground.height(0.0, 0.0).shape == ()


def test_no_crack_opens_where_slabs_meet() -> None:
    """The ends of slabs in a row are sums of lengths that no binary number is."""
    ground = stairs(0.1, 0.12, 50, begin=0.5)
    edges = 0.5 + 0.12 * np.arange(51)
    assert ground.height(edges, 0.0 * edges).min() >= 0.0


def test_extents_are_measured_on_the_level() -> None:
    slab = Slab(0.0, 0.0, 0.0, 1.0, 1.0, pitch=-radians(30.0))
    ground = SlabGround((slab,), -5.0)
    assert ground.height(0.999, 0.0) == pytest.approx(0.999 * tan(radians(30.0)))
    assert ground.height(1.001, 0.0) == -5.0
    assert slab.pose[:3, 2] == pytest.approx((-sin(radians(30)), 0.0, cos(radians(30))))


@pytest.mark.parametrize(
    ("values", "argument"),
    [
        ({"half_length": 0.0}, "half_length"),
        ({"half_width": -1.0}, "half_width"),
        ({"z": float("nan")}, "z"),
        ({"pitch": 1.2}, "pitch"),
        ({"roll": "steep"}, "roll"),
    ],
)
def test_slabs_that_cannot_be(values: dict[str, float], argument: str) -> None:
    fields = {"x": 0.0, "y": 0.0, "z": 0.0, "half_length": 1.0, "half_width": 1.0, **values}
    with pytest.raises(InvalidInput) as told:
        Slab(**fields)
    assert told.value.argument == argument
