"""A record that is written as the run goes: a folder of blocks, each a whole file.

A process that is killed leaves all but the rows since its last block; `Record.load` reads the
folder as it does a file.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError, as_path, make_folder, short
from preview_walk.record.file import read_file, write_file

EVERY = 5.0
"""Simulated time (s) of a block."""

_NAME = "{:06d}.npz"


class BlockWriter:
    """Writes blocks into a folder.

    Attributes:
        folder: where; blocks of an earlier run in it are removed.
        failed: why the last block could not be written; None while all were. A disk that is full
            ends the blocks and not the run.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Make the folder.

        Raises:
            OutputError: it cannot be made or written to.
        """
        self.folder = as_path(folder)
        self.failed: OutputError | None = None
        self._count = 0
        make_folder(self.folder, ())
        remove_blocks(self.folder, keep_folder=True)

    def write(self, facts: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
        """Write the next block: the facts of the run so far, and the rows since the last block."""
        if self.failed is not None:
            return
        try:
            write_file(self.folder / _NAME.format(self._count), facts, arrays, compress=False)
        except OutputError as error:
            self.failed = error
        self._count += 1


def read_blocks(
    folder: str | os.PathLike[str], names: Iterable[str], optional: Iterable[str] = ()
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the facts of the last block and the arrays of all of them, as `read_file` does.

    Raises:
        InvalidInput: the folder holds no block, or one that is damaged.
    """
    place = as_path(folder)
    files = _blocks(place)
    if not files:
        raise InvalidInput(f"the folder {short(place)} holds no record's blocks.", argument="path")
    read = [read_file(file, list(names), list(optional)) for file in files]
    facts = read[-1][0]
    parts = [arrays for _, arrays in read]
    both = {name for arrays in parts for name in arrays}
    return facts, {name: np.concatenate([arrays[name] for arrays in parts]) for name in both}


def remove_blocks(folder: Path, *, keep_folder: bool = False) -> None:
    """Remove a folder of blocks, if it is there; other files in it stay, and the folder then too.

    Raises:
        OutputError: they cannot be removed.
    """
    try:
        for file in _blocks(folder):
            file.unlink()
        if not keep_folder and folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()
    except OSError as error:
        raise OutputError(f"cannot remove {short(folder)}: {error.strerror}.") from error


def _blocks(folder: Path) -> list[Path]:
    """Return the blocks of a folder in order."""
    return sorted(folder.glob("[0-9]" * 6 + ".npz")) if folder.is_dir() else []
