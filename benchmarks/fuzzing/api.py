"""Calls of the library with one to three odd arguments; the tables are those of the tests."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from random import Random
from typing import Any

from fuzzing.values import draw_value, value_of
from fuzzing.verdict import ACCEPTED, REFUSED, Verdict, of_error

TESTS = Path(__file__).parents[2] / "tests"
TABLES = ("test_bad_calls", "test_arguments", "preview.test_bad_input")
DRAWN = (
    "plot", "plot_all", "write_picture", "save_plot", "run_in_viewer", "render_video", "frames",
)  # fmt: skip
"""Calls that draw for seconds where they are right."""


@lru_cache(maxsize=1)
def calls() -> dict[str, tuple[Callable[..., object], dict[str, Any]]]:
    """Return every call: its function and arguments that are right."""
    sys.path.insert(0, str(TESTS))
    table: dict[str, Any] = {}
    for name in TABLES:
        for call, entry in import_module(name).CALLS.items():
            # The preview room's table has functions of the one odd value.
            plain = entry if isinstance(entry, tuple) else (lambda value, f=entry: f(value), None)
            table[f"{name}/{call}"] = plain
    return table


def draw(rng: Random) -> list[str]:
    """Return a call and the odd values of some of its arguments."""
    call = rng.choice(sorted(calls()))
    arguments = calls()[call][1]
    names = ["value"] if arguments is None else sorted(arguments)
    chosen = rng.sample(names, min(len(names), rng.choice((1, 1, 1, 2, 3))))
    return [call, *(f"{name}={draw_value(rng)}" for name in chosen)]


def attempt(parts: list[str], folder: Path) -> Verdict:
    """Make the call; what somebody's own function raises in it is not the library's."""
    if not parts or parts[0] not in calls() or (calls()[parts[0]][1] is None and len(parts) < 2):
        return Verdict(REFUSED, "no call")
    function, right = calls()[parts[0]]
    odd = dict(part.split("=", 1) for part in parts[1:])
    if parts[0].split("/")[1] in DRAWN and not odd:
        return Verdict(ACCEPTED)
    given = {name: value_of(text) for name, text in odd.items()}
    if any(callable(value) for value in given.values()) and {"on_tick", "progress"} & set(given):
        return Verdict(ACCEPTED)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            function(**{**(right or {}), **given})
    except KeyboardInterrupt:
        return Verdict(ACCEPTED)
    except Exception as error:
        return of_error(error, named=True)
    return Verdict(ACCEPTED)
