"""Record files: bytes, arrays and facts changed; what still loads is used."""

from __future__ import annotations

import json
import pickle
import warnings
import zipfile
from functools import lru_cache
from io import BytesIO
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

import preview_walk as pw
from fuzzing.values import NUMBERS, draw_value, value_of
from fuzzing.verdict import ACCEPTED, Verdict, of_error
from preview_walk.record.record import Record

SETTINGS = "settings"
SHAPES = ("x[:0]", "x[:1]", "x[::2]", "x[..., None]", "x[None]", "x.ravel()", "x[:, ::-1]", "x.T")


@lru_cache(maxsize=1)
def base() -> tuple[dict[str, Any], dict[str, Any]]:
    """Return arrays and facts of the file of a short walk with two plans."""
    robot = pw.load_robot("humanoid-walker")
    walk = pw.Walk.standing(robot).run(until=0.04)
    walk.command(0.2, 0.0, 0.0)
    record = walk.run(until=0.1).record()
    with TemporaryDirectory() as folder:
        path = record.save(Path(folder) / "record.npz")
        with np.load(path) as file:
            arrays = {name: file[name] for name in file.files}
    facts = json.loads(str(arrays.pop(SETTINGS)))
    return arrays, facts


def draw(rng: Random) -> list[str]:
    """Return changes, one to three."""
    arrays, facts = base()
    parts = []
    for _ in range(rng.choice((1, 1, 2, 3))):
        kind = rng.random()
        name, fact = rng.choice(sorted(arrays)), rng.choice(sorted(facts))
        if kind < 0.25:
            parts.append(f"byte {rng.random():.6f} {rng.randrange(256)}")
        elif kind < 0.3:
            parts.append(f"cut {rng.random():.6f}")
        elif kind < 0.35:
            parts.append(f"drop {rng.choice((name, SETTINGS))}")
        elif kind < 0.5:
            parts.append(f"fact {fact} {json.dumps(_json(rng))}")
        elif kind < 0.6:
            parts.append(f"array {name} {rng.choice(SHAPES)}")
        elif kind < 0.8:
            parts.append(f"array {name} np.full_like(x, {rng.choice(NUMBERS)})")
        else:
            parts.append(f"array {name} {draw_value(rng)}")
    return parts


def _json(rng: Random) -> Any:
    plain: tuple[Any, ...] = (None, True, -1, 0, 1e308, "", "text", [], {}, [1, "a"], {"a": [None]})
    return rng.choice((*plain, float("nan"), float("inf"), "x" * 3000, 10**30, [[]], [1e308] * 3))


def _file(parts: list[str]) -> bytes:
    """Return the bytes of the changed file; a change that cannot be made is left out."""
    arrays, facts = base()
    arrays, facts = dict(arrays), dict(facts)
    dropped, late = set(), []
    for part in parts:
        kind, _, rest = part.partition(" ")
        name, _, text = rest.partition(" ")
        if kind == "drop":
            dropped.add(name)
        elif kind == "fact":
            facts[name] = json.loads(text)
        elif kind == "array":
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    arrays[name] = np.asarray(value_of(text, x=arrays[name]))
            except Exception:
                continue
        else:
            late.append((kind, float(name), text))
    arrays[SETTINGS] = np.array(json.dumps(facts))
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            if name not in dropped:
                member = BytesIO()
                try:
                    np.lib.format.write_array(member, array, allow_pickle=True)
                except (AttributeError, TypeError, pickle.PicklingError):
                    continue
                archive.writestr(f"{name}.npy", member.getvalue())
    content = bytearray(buffer.getvalue())
    for kind, share, text in late:
        at = min(int(share * len(content)), len(content) - 1)
        content = content[:at] if kind == "cut" else content
        if kind == "byte" and content:
            content[at] = int(text)
    return bytes(content)


def attempt(parts: list[str], folder: Path) -> Verdict:
    """Load the file and use what it holds."""
    path = folder / "record.npz"
    path.write_bytes(_file(parts))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _use(Record.load(path), folder)
    except Exception as error:
        return of_error(error)
    return Verdict(ACCEPTED)


def _use(record: Record, folder: Path) -> None:
    repr(record)
    summary = record.summary()
    str(summary)
    summary.write(folder / "summary.json")
    again = pickle.loads(pickle.dumps(record))
    record.differences(again)
    for number in range(len(record.plans)):
        pw.as_plan(record.plans[number])
    record.save(folder / "again.npz")
    Record.load(folder / "again.npz")
    if len(record):
        pw.top_view(record)
