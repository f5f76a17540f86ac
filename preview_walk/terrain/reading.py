"""Grounds by a line of text: NAME:KEY=VALUE,KEY=VALUE, as the command takes them."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature

from preview_walk.errors import InvalidInput
from preview_walk.terrain.shapes import blocks, ramps, slope, stairs, stepping_stones
from preview_walk.terrain.slabs import SlabGround

GROUNDS: dict[str, Callable[..., SlabGround]] = {
    "slope": slope,
    "stairs": stairs,
    "ramps": ramps,
    "blocks": blocks,
    "stones": stepping_stones,
}
"""The grounds that have a name."""


def read_ground(text: str) -> SlabGround:
    """Return the ground that a text names, as "stairs:rise=0.1,count=6".

    Args:
        text: a name of `GROUNDS`, then the arguments of its function that are not the default.

    Raises:
        InvalidInput: there is no such ground, it has no such argument, or no such ground can be.
    """
    name, _, rest = str(text).partition(":")
    if name not in GROUNDS:
        raise InvalidInput(
            f"ground must be one of {', '.join(GROUNDS)}, as in slope:degrees=8, got '{text}'.",
            "ground",
        )
    make = GROUNDS[name]
    defaults = {key: value.default for key, value in signature(make).parameters.items()}
    given: dict[str, float | int | bool] = {}
    for part in filter(None, rest.split(",")):
        key, _, value = (piece.strip() for piece in part.partition("="))
        if key not in defaults:
            raise InvalidInput(
                f"the ground '{name}' has {', '.join(defaults)}, got '{part}'.", "ground"
            )
        given[key] = _number(value, defaults[key], part)
    try:
        return make(**given)
    except InvalidInput as error:
        raise InvalidInput(f"the ground '{name}': {error}", "ground") from error


def _number(value: str, default: object, part: str) -> float | int | bool:
    """Return a value of the kind that the default is."""
    try:
        if isinstance(default, bool):
            return {"yes": True, "no": False}[value]
        return int(value) if isinstance(default, int) else float(value)
    except (KeyError, ValueError):
        kind = "yes or no" if isinstance(default, bool) else "a number"
        kind = "a whole number" if type(default) is int else kind
        raise InvalidInput(f"expected {kind} in the ground's '{part}'.", "ground") from None
