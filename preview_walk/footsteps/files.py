"""Footsteps from a file: CSV or JSON, one row or object a footstep."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Mapping
from math import degrees, radians
from pathlib import Path
from typing import Any

from preview_walk.arguments import MOST, shown
from preview_walk.errors import InvalidInput
from preview_walk.files import as_path, short, whole_file
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import as_plan

LARGEST = 50_000_000
"""Bytes of a file of footsteps."""

NAMES = ("foot", "x", "y", "z", "yaw_deg", "lift", "time", "type")
"""Columns of a CSV and keys of a JSON object, in the order in which they are written."""

_MUST, _WORDS = ("foot", "x", "y", "time"), ("foot", "type")


def read_footsteps(path: str | os.PathLike[str]) -> FootstepPlan:
    """Return the plan of a file.

    The first two footsteps are the soles that the robot stands on at first, of type "stance"; the
    others, "swing_end", are steps. A CSV has a line of names above the rows, a JSON file is a list
    of objects; names are foot ("left" or "right"), x, y (m, world, of the sole's centre), time
    (landing, s; of a stance the plan's start), and, if need be, z (m, else 0), yaw_deg (degrees,
    else 0), lift (s, else a fifth of the time since the landing before it) and type (else by place:
    two stances, then steps). Objects may have the walking lab's `pos` in place of x and y.

    Args:
        path: of the file, by custom `.csv` or `.json`.

    Raises:
        InvalidInput: it cannot be read, or holds no plan; names the row.
    """
    place = as_path(path)
    try:
        if place.stat().st_size > LARGEST:
            raise InvalidInput(f"{short(place)} is too large for a file of footsteps.", "footsteps")
        text = place.read_text(encoding="utf-8-sig")
        rows = json.loads(text) if place.suffix.lower() == ".json" else _csv_rows(text)
    except OSError as error:
        raise InvalidInput(f"cannot read {short(place)}: {error.strerror}.", "footsteps") from None
    except (ValueError, RecursionError, csv.Error) as error:
        if isinstance(error, InvalidInput):
            raise
        raise InvalidInput(f"{short(place)} holds no footsteps: {error}.", "footsteps") from None
    if not isinstance(rows, list) or not 2 <= len(rows) <= MOST:
        raise InvalidInput(
            f"{short(place)} must hold a list of two footsteps or more, got {shown(rows)}.",
            "footsteps",
        )
    try:
        return as_plan([_dictionary(row, number) for number, row in enumerate(rows)])
    except InvalidInput as error:
        raise InvalidInput(f"{short(place)}: {error}", "footsteps") from error


def _csv_rows(text: str) -> list[dict[str, Any]]:
    """Return the rows of a CSV; empty cells are left out."""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    found = []
    for row in csv.DictReader(lines, skipinitialspace=True):
        if None in row or None in row.values():
            raise ValueError("a row has not as many cells as there are names")
        found.append({name.strip(): cell.strip() for name, cell in row.items() if cell.strip()})
    return found


def _dictionary(row: object, number: int) -> dict[str, Any]:
    """Return a row as the lab's dictionary of a footstep."""
    if not isinstance(row, Mapping):
        raise InvalidInput(f"footstep {number} must be an object, got {shown(row)}.")
    given = dict(row)
    if "pos" in given:
        given.update(zip(("x", "y", "z"), given.pop("pos"), strict=False))
    unknown, missing = set(given) - set(NAMES), [name for name in _MUST if name not in given]
    if unknown or missing:
        wrong = f"no {missing[0]}" if missing else f"'{min(map(str, unknown))}'"
        raise InvalidInput(f"footstep {number} must have {', '.join(NAMES)}; got {wrong}.")
    numbers = {name: _number(given[name], name, number) for name in given if name not in _WORDS}
    found = {
        "foot": given["foot"],
        "pos": (numbers["x"], numbers["y"], numbers.get("z", 0.0)),
        "time": numbers["time"],
        "yaw": radians(numbers.get("yaw_deg", 0.0)),
        "type": given.get("type", "stance" if number < 2 else "swing_end"),
    }
    return {**found, "lift": numbers["lift"]} if "lift" in numbers else found


def _number(value: object, name: str, number: int) -> float:
    try:
        return float(str(value) if isinstance(value, str | int | float) else "none")
    except ValueError:
        raise InvalidInput(
            f"{name} of footstep {number} must be a number, got {shown(value)}."
        ) from None


def write_footsteps(plan: FootstepPlan, path: str | os.PathLike[str]) -> Path:
    """Write a plan's footsteps as CSV, for `read_footsteps`; return the file's path.

    Roll and pitch of soles on uneven ground are left out: laid on the ground again, they come back.

    Args:
        plan: the footsteps.
        path: of the file.

    Raises:
        OutputError: the file cannot be written.
    """
    target = as_path(path)
    with whole_file(target) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(NAMES)
        for step in plan:
            x, y, z = step.pos.tolist()
            writer.writerow(
                (step.foot, x, y, z, degrees(step.yaw), step.lift, step.land, step.type)
            )
    return target
