"""Grounds by a line of text: NAME:KEY=VALUE,KEY=VALUE, as the command takes them."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature

from preview_walk.errors import InvalidInput
from preview_walk.terrain.ground import Ground
from preview_walk.terrain.height_field import height_field, rough
from preview_walk.terrain.shapes import blocks, ramps, slope, stairs, stepping_stones

GROUNDS: dict[str, Callable[..., Ground]] = {
    "slope": slope,
    "stairs": stairs,
    "ramps": ramps,
    "blocks": blocks,
    "stones": stepping_stones,
    "rough": rough,
    "heightfield": height_field,
}
"""The grounds that have a name."""


def read_ground(text: str) -> Ground:
    """Return the ground that a text names, as "stairs:rise=0.1,count=6".

    Args:
        text: a name of `GROUNDS`, then the arguments of its function that are not the default; the
            file of a height field comes first, as in "heightfield:hills.png,height=0.1".

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
    given: dict[str, float | int | bool | str] = {}
    parts = list(filter(None, rest.split(",")))
    if "file" in defaults:
        if not parts:
            raise InvalidInput(f"the ground '{name}' needs a file, as in {name}:FILE.", "ground")
        given["file"] = parts.pop(0).removeprefix("file=")
    for part in parts:
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
