"""The file of a record: an .npz of plain arrays, written whole, read without trust."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import as_path, whole_file

FORMAT = 1
"""Number of the file format, raised when a reader of the old one would misread the new."""

FACTS = "settings"
"""Name under which the file holds the facts of the run, as a JSON string."""

SMALL = 64 * 2**20
"""Bytes that any file may unpack to."""

EXPANSION = 200.0
"""A larger file may unpack to this many times its size; a walk's unpacks to about 1.4 times."""


def write_file(
    path: str | os.PathLike[str],
    facts: Mapping[str, Any],
    arrays: Mapping[str, NDArray[Any]],
    *,
    compress: bool = True,
) -> Path:
    """Write facts (plain JSON values) and arrays to one file, whole or not at all.

    Args:
        path: of the file.
        facts: of the run.
        arrays: by name.
        compress: as small as is quickly done; else as quickly as can be.

    Raises:
        OutputError: the file cannot be written.
    """
    text = np.array(json.dumps({"format": FORMAT, **facts}))
    with (
        whole_file(path) as part,
        zipfile.ZipFile(part, "w", compresslevel=1) as archive,
    ):
        for name, array in {FACTS: text, **arrays}.items():
            # ZipInfo's fixed date: the same record makes the same file.
            entry = zipfile.ZipInfo(f"{name}.npy")
            entry.compress_type = zipfile.ZIP_DEFLATED if compress else zipfile.ZIP_STORED
            with archive.open(entry, "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.asarray(array, order="C"), allow_pickle=False)
    return Path(path)


def read_file(
    path: str | os.PathLike[str], names: Iterable[str], optional: Iterable[str] = ()
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the facts and the arrays of these names; what else the file holds is not read.

    Args:
        path: of the file.
        names: of arrays that it must have.
        optional: names of those that it may have.

    Raises:
        InvalidInput: the file is missing, is no record, is damaged, has a newer format, or would
            take memory out of proportion to its size.
    """
    path = as_path(path)
    shown = os.fspath(path)
    if not os.path.exists(path):  # which answers where `Path.exists` raises: a name too long
        raise InvalidInput(f"record file {shown} does not exist.", argument="path")
    try:
        if not path.is_file():
            raise ValueError("it is not a file")
        with zipfile.ZipFile(path) as archive:
            there = set(archive.namelist())
            wanted = [FACTS, *names, *(name for name in optional if f"{name}.npy" in there)]
            members = {name: archive.getinfo(f"{name}.npy") for name in wanted}
            _require_proportion(list(members.values()), path.stat().st_size)
            arrays = {name: _read_array(archive, entry) for name, entry in members.items()}
        facts = json.loads(str(arrays.pop(FACTS)[()]))
        if not isinstance(facts, dict) or not isinstance(facts.get("format"), int):
            raise ValueError("its settings are no table with a format number")
    # A damaged archive makes its readers raise whatever they come across: of zlib, of struct, of
    # the parser of a header, out of memory.
    except Exception as error:
        reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
        raise InvalidInput(
            f"{shown} is not a record written by preview_walk ({reason:.200}).", argument="path"
        ) from error
    if facts["format"] > FORMAT:
        raise InvalidInput(
            f"{shown} was written by a newer preview_walk; "
            f"this one reads records up to format {FORMAT}.",
            argument="path",
        )
    return facts, arrays


def _require_proportion(members: list[zipfile.ZipInfo], size: int) -> None:
    """Refuse what would unpack to far more than a record of its size (bytes) could."""
    total = sum(member.file_size for member in members)
    if total > max(SMALL, EXPANSION * size):
        raise ValueError(f"its {size} bytes would unpack to {total}")


def _read_array(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> NDArray[Any]:
    """Read one array; its header must agree with the size that the archive states."""
    with archive.open(entry) as file:
        shape, dtype = _read_header(file)
        if dtype.hasobject or any(length < 0 for length in shape):
            raise ValueError(f"{entry.filename} holds no plain numbers")
        count = 1
        for length in shape:
            count *= length
        left = entry.file_size - file.tell()
        if count * dtype.itemsize != left:
            raise ValueError(f"{entry.filename} states the shape {shape} but holds {left} bytes")
        file.seek(0)
        array: NDArray[Any] = np.lib.format.read_array(file, allow_pickle=False)
        return array


def _read_header(file: IO[bytes]) -> tuple[tuple[int, ...], np.dtype[Any]]:
    version = np.lib.format.read_magic(file)
    if version == (1, 0):
        shape, _, dtype = np.lib.format.read_array_header_1_0(file)
    elif version == (2, 0):
        shape, _, dtype = np.lib.format.read_array_header_2_0(file)
    else:
        raise ValueError(f"its arrays are of version {version}")
    return shape, dtype
