"""A ground as plain values, as a record keeps it, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple
from typing import Any

from preview_walk.errors import InvalidInput
from preview_walk.terrain.ground import FlatGround, Ground, Plane
from preview_walk.terrain.height_field import HeightField
from preview_walk.terrain.slabs import Slab, SlabGround


def facts_of(ground: Ground) -> dict[str, Any]:
    """Return a ground as JSON values; only its kind for a class of one's own."""
    if isinstance(ground, FlatGround):
        return {"kind": "flat", "z": ground.z}
    if isinstance(ground, Plane):
        return {"kind": "plane", "z": ground.z, "ahead": ground.ahead, "left": ground.left}
    if isinstance(ground, SlabGround):
        slabs = [list(astuple(slab)) for slab in ground.slabs]
        return {"kind": "slabs", "slabs": slabs, "floor": ground.floor}
    if isinstance(ground, HeightField):
        where = {"spacing": ground.spacing, "x": ground.x, "y": ground.y}
        return {"kind": "heights", "heights": ground.heights.tolist(), **where}
    return {"kind": type(ground).__name__}


def ground_of(facts: Mapping[str, Any]) -> Ground | None:
    """Return the ground that `facts_of` made these values of; None for one that it did not know.

    Raises:
        InvalidInput: the values are not those of a ground.
    """
    given = {name: value for name, value in facts.items() if name != "kind"}
    try:
        if facts.get("kind") == "slabs":
            return SlabGround(tuple(Slab(*slab) for slab in facts["slabs"]), facts["floor"])
        make = {"flat": FlatGround, "plane": Plane, "heights": HeightField}.get(
            str(facts.get("kind"))
        )
        return None if make is None else make(**given)
    except (TypeError, KeyError) as error:
        raise InvalidInput(f"the record's ground cannot be read: {error}.", "ground") from None
