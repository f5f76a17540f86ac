"""What a function returned, as a row's figures: plain values by name, and whether it succeeded."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.record.record import Record
from preview_walk.record.summary import Summary
from preview_walk.studies.factors import plain

SUCCESS = "success"
"""The figure by which a function of one's own tells whether its case succeeded."""

_AXES = "xyz"


def figures_of(result: object, metrics: Mapping[str, Callable[[Any], Any]]) -> dict[str, Any]:
    """Return the figures of what a study's function returned.

    A `Record` gives those of its summary, lists of axes as `com_error_rms_x` and so on, and
    `success` where the robot did not fall; a mapping or a dataclass gives its own; a number is the
    figure `value`.

    Args:
        result: of the function.
        metrics: further figures by name, functions of the result.

    Raises:
        InvalidInput: the result is none of these.
    """
    found: dict[str, Any] = {}
    if isinstance(result, Record):
        found = _of_summary(result.summary())
    elif isinstance(result, Summary):
        found = _of_summary(result)
    elif isinstance(result, Mapping):
        found = dict(result)
    elif is_dataclass(result) and not isinstance(result, type):
        found = asdict(result)
    elif isinstance(result, int | float) or hasattr(result, "dtype"):
        found = {"value": result}
    elif result is not None or not metrics:
        raise InvalidInput(
            "a study's function must return figures by name, a record or a number, "
            f"got {shown(result)}."
        )
    more = {name: function(result) for name, function in metrics.items()}
    return {str(name): storable(value) for name, value in {**found, **more}.items()}


def succeeded(figures: Mapping[str, Any]) -> bool:
    """Return whether a case succeeded: what `success` says, and yes where nothing does."""
    return bool(figures.get(SUCCESS, True))


def storable(value: Any) -> Any:
    """Return a value as a table holds it: a number, a text or None, all else as JSON or text."""
    value = plain(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    try:
        return json.dumps(value)
    except (TypeError, ValueError):
        return repr(value)


def _of_summary(summary: Summary) -> dict[str, Any]:
    flat = dict(_flat("", asdict(summary)))
    return {SUCCESS: not summary.fell, **flat}


def _flat(head: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the plain values in nested ones, by names put together."""
    if isinstance(value, Mapping):
        for name, item in value.items():
            yield from _flat(f"{head}_{name}" if head else str(name), item)
    elif isinstance(value, list):
        for axis, item in zip(_AXES, value, strict=False):
            yield f"{head}_{axis}", item
    else:
        yield head, value
