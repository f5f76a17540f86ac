"""A study from a TOML file."""

from __future__ import annotations

import os
import runpy
from collections.abc import Callable, Mapping
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import Any, TypeGuard

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.files import as_path, read_toml
from preview_walk.studies.margin import Margin
from preview_walk.studies.study import Study
from preview_walk.studies.walk_case import walk_case

_SPREADS = {
    "uniform": ("low", "high"),
    "loguniform": ("low", "high"),
    "normal": ("mean", "standard deviation"),
}
"""Random factors of a file, and their two numbers."""

_STEPS = ("from", "to", "count")
"""Evenly spaced levels of a file."""


def read_study(path: str | os.PathLike[str]) -> Study:
    """Return the study that a TOML file describes.

    Its keys are the attributes of `Study`; `factors` and `margin` are tables. A level is a value, a
    list of values, `{ from = 0, to = 100, count = 11 }`, or a random one: `{ uniform = [0, 100] }`,
    `{ loguniform = [1, 100] }`, `{ normal = [0, 1] }`. `function` is "module:name" or
    "file.py:name", the file beside the study's; without it the case is a walk (`walk_case`).

    Args:
        path: of the file.

    Raises:
        InvalidInput: it cannot be read, or a key or value is not a study's.
    """
    place = as_path(path)
    given = read_toml(place)
    allowed = {field.name for field in fields(Study)} - {"metrics"}
    unknown = sorted(set(given) - allowed)
    if unknown:
        raise InvalidInput(
            f"a study's file must have the keys {', '.join(sorted(allowed))}; got {unknown[0]}."
        )
    if "factors" not in given:
        raise InvalidInput("a study's file must have factors.", argument="factors")
    given["factors"] = _factors(given["factors"])
    given["function"] = _function(given.get("function"), place.parent)
    if "margin" in given:
        given["margin"] = _margin(given["margin"])
    return Study(**{"name": place.stem, **given})


def _factors(given: object) -> Any:
    if isinstance(given, Mapping):
        return {name: _levels(name, levels) for name, levels in given.items()}
    return given


def _levels(name: str, given: object) -> Any:
    """Return a factor's levels, read where they are given in words."""
    if not isinstance(given, Mapping):
        return given
    if set(given) == set(_STEPS):
        import numpy as np

        first, last, count = (given[key] for key in _STEPS)
        try:
            return np.linspace(first, last, count).tolist()
        except (TypeError, ValueError):
            given = dict(given)
    kind, numbers = next(iter(given.items()), ("nothing", None))
    if len(given) != 1 or kind not in _SPREADS or not _are_two(numbers):
        forms = ", ".join(f"{key} = [{', '.join(names)}]" for key, names in _SPREADS.items())
        raise InvalidInput(
            f"factor '{name}' must be values, or one of {', '.join(_STEPS)} together; {forms}; "
            f"got {shown(dict(given))}.",
            argument="factors",
        )
    return _draw(kind, float(numbers[0]), float(numbers[1]))


def _are_two(numbers: object) -> TypeGuard[list[float]]:
    return isinstance(numbers, list) and [type(n) in (int, float) for n in numbers] == [True, True]


def _draw(kind: str, first: float, second: float) -> Any:
    from scipy import stats

    if kind == "uniform":
        return stats.uniform(first, second - first)
    return stats.loguniform(first, second) if kind == "loguniform" else stats.norm(first, second)


def _margin(given: object) -> Margin:
    names = {field.name for field in fields(Margin)}
    if not isinstance(given, Mapping) or set(given) - names:
        raise InvalidInput(
            f"margin must have the keys {', '.join(sorted(names))}, got {shown(given)}.",
            argument="margin",
        )
    try:
        return Margin(**given)
    except TypeError:
        raise InvalidInput(
            "margin must have factor, low, high and precision.", argument="margin"
        ) from None


def _function(given: object, folder: Path) -> Callable[..., Any]:
    """Return the function that a file names."""
    if given is None:
        return walk_case
    source, _, name = given.rpartition(":") if isinstance(given, str) else ("", "", "")
    if not source or not name:
        raise InvalidInput(
            f"function must be 'module:name' or 'file.py:name', got {shown(given)}.",
            argument="function",
        )
    try:
        if source.endswith(".py"):
            # Under a name that no module has, so that workers get the function itself.
            found: Any = runpy.run_path(str(folder / source), run_name="study_file").get(name)
        else:
            found = getattr(import_module(source), name, None)
    except Exception as error:
        raise InvalidInput(
            f"function: cannot load {source}: {type(error).__name__}: {error}.",
            argument="function",
        ) from error
    if not callable(found):
        raise InvalidInput(f"function: {source} has no function '{name}'.", argument="function")
    function: Callable[..., Any] = found
    return function
