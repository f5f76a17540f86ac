"""A case: one call of a study's function, with a seed of its own that nothing else changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

import numpy as np

from preview_walk.studies.factors import Cell, named, plain


@dataclass(frozen=True)
class Case:
    """One call of a study's function.

    Attributes:
        index: its place in the study.
        values: of all factors, by name.
        repeat: which one of its cell, from 0.
        seed: of whatever is random in it.
        key: names it in files: the same values, repeat and seed of the study have the same key,
            wherever in a study they stand.
    """

    index: int
    values: Mapping[str, Any]
    repeat: int
    seed: int
    key: str


def case_of(cell: Cell, index: int, repeat: int, seed: int) -> Case:
    """Return the case that is one repeat of a cell.

    Its seed follows from the study's and from what the case is, not from its place, by NumPy's
    `SeedSequence`: a study that grows keeps the cases that it has.

    Args:
        cell: of the study.
        index: place of the case.
        repeat: which one of the cell.
        seed: of the study.
    """
    text = ";".join(f"{name}={named(value)}" for name, value in sorted(cell.values.items()))
    digest = sha256(f"{text};{sorted(cell.draws)};{repeat}".encode()).digest()
    words = tuple(np.frombuffer(digest, dtype="<u4").tolist())
    own, drawing = np.random.SeedSequence(seed, spawn_key=words).spawn(2)
    random = np.random.default_rng(drawing)
    drawn = {name: plain(cell.draws[name].rvs(random_state=random)) for name in sorted(cell.draws)}
    key = sha256(f"{digest.hex()};{seed};{sorted(drawn.items())}".encode()).hexdigest()[:16]
    return Case(index, {**cell.values, **drawn}, repeat, int(own.generate_state(1)[0]), key)
