"""Grounds go through a record's plain values and come back the same."""

from __future__ import annotations

import json

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.terrain.facts import facts_of, ground_of
from preview_walk.terrain.ground import FlatGround, Ground, Plane
from preview_walk.terrain.height_field import rough
from preview_walk.terrain.shapes import blocks, slope


@pytest.mark.parametrize(
    "ground", [FlatGround(0.2), Plane(0.1, 0.05, -0.02), slope(8.0, bank=3.0), blocks(), rough()]
)
def test_a_ground_comes_back_through_json(ground: Ground) -> None:
    again = ground_of(json.loads(json.dumps(facts_of(ground))))
    assert again is not None
    x, y = np.random.default_rng(0).uniform(-0.9, 4.0, (2, 200))
    assert (again.height(x, y) == ground.height(x, y)).all()
    assert (again.normal(1.0, 0.2) == ground.normal(1.0, 0.2)).all()


def test_a_ground_of_ones_own_leaves_its_name() -> None:
    class Moon:
        pass

    facts = facts_of(Moon())  # type: ignore[arg-type]
    assert facts == {"kind": "Moon"}
    assert ground_of(facts) is None
    assert ground_of({}) is None


@pytest.mark.parametrize(
    "facts",
    [
        {"kind": "slabs"},
        {"kind": "slabs", "slabs": [[1, 2]], "floor": 0.0},
        {"kind": "flat", "depth": 1.0},
        {"kind": "heights", "heights": "high", "spacing": 1.0, "x": 0.0, "y": 0.0},
    ],
)
def test_facts_of_no_ground_are_refused(facts: dict[str, object]) -> None:
    with pytest.raises(InvalidInput):
        ground_of(facts)
