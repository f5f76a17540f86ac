"""Grounds by name: heights along them by hand."""

from __future__ import annotations

from math import radians, tan

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.terrain.reading import GROUNDS, read_ground
from preview_walk.terrain.shapes import BEGIN, blocks, ramps, slope, stairs, stepping_stones


@pytest.mark.parametrize("name", sorted(set(GROUNDS) - {"heightfield"}))
def test_all_begin_with_a_level_place_to_stand_on(name: str) -> None:
    ground = GROUNDS[name]()
    x, y = np.meshgrid(np.linspace(-0.4, BEGIN - 0.01, 9), np.linspace(-0.4, 0.4, 5))
    assert (ground.height(x, y) == 0.0).all()
    assert ground.floor < -0.5


def test_stairs_up_and_back() -> None:
    ground = stairs(0.15, 0.28, 3, back=True)
    middles = BEGIN + np.array((-0.1, 0.14, 0.42, 1.0, 1.70, 1.98, 2.3, 4.0))
    assert ground.height(middles, 0.0 * middles) == pytest.approx(
        [0.0, 0.15, 0.30, 0.45, 0.30, 0.15, 0.0, 0.0]
    )
    assert stairs(-0.1, 0.3, 2).height(BEGIN + 0.45, 0.0) == pytest.approx(-0.2)


def test_slopes_and_ramps_are_continuous() -> None:
    rise = tan(radians(10.0))
    assert slope(10.0, length=4.0).height(BEGIN + 3.0, 0.5) == pytest.approx(3.0 * rise)
    assert slope(10.0, length=4.0).height(BEGIN + 5.0, 0.5) == pytest.approx(4.0 * rise)
    assert slope(0.0, bank=10.0).height(BEGIN + 1.0, 0.5) == pytest.approx(0.5 * rise)
    x = np.linspace(0.0, 5.0, 5001)
    heights = ramps(8.0, 1.0, 4).height(x, 0.0 * x)
    assert np.abs(np.diff(heights)).max() < 1.01 * tan(radians(8.0)) * 1e-3
    assert heights.max() == pytest.approx(tan(radians(8.0)), abs=1e-3)


def test_blocks_are_random_by_their_seed() -> None:
    x, y = np.meshgrid(BEGIN + 0.15 + 0.3 * np.arange(20), 0.15 + 0.3 * np.arange(-4, 4))
    one, same, other = (blocks(0.03, 0.3, seed=seed).height(x, y) for seed in (1, 1, 2))
    assert (one == same).all()
    assert (one != other).mean() > 0.99
    assert 0.025 < np.abs(one).max() <= 0.03
    assert len(np.unique(one)) == one.size


def test_stones_lie_under_each_foot_over_a_pit() -> None:
    ground = stepping_stones(0.3, 0.1, 3, width=0.4)
    x = BEGIN + 0.25
    assert ground.height([x, x, x], [0.2, -0.2, 0.0]) == pytest.approx([0.0, 0.0, ground.floor])
    assert ground.height(BEGIN + 0.45, 0.2) == ground.floor


def test_a_text_names_a_ground() -> None:
    ground = read_ground("stairs:rise=0.1,count=2,back=yes")
    assert ground.slabs == stairs(0.1, count=2, back=True).slabs
    assert read_ground("slope").slabs == slope().slabs


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("hills", "ground must be one of slope, stairs"),
        ("stairs:height=1", "the ground 'stairs' has rise, tread, count, back, begin"),
        ("stairs:count=two", "expected a whole number in the ground's 'count=two'"),
        ("stairs:back=1", "expected yes or no"),
        ("stairs:tread=-0.2", "the ground 'stairs': tread must be"),
        ("rough:height=-1", "the ground 'rough': height must be"),
        ("heightfield", "the ground 'heightfield' needs a file, as in heightfield:FILE"),
        ("heightfield:none.png", "the ground 'heightfield': the height field 'none.png' cannot"),
        ("heightfield:a.npy,height=x", "expected a number in the ground's 'height=x'"),
        ("slope:degrees=nan", "the ground 'slope': degrees must be"),
        ("slope:degrees=80", "the ground 'slope': degrees must be at most 57"),
    ],
)
def test_grounds_that_cannot_be(text: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as told:
        read_ground(text)
    assert str(told.value).startswith(sentence)
    assert told.value.argument == "ground"
