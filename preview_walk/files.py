"""Files that are whole or absent: a full disk or Ctrl-C never leaves half of one."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from preview_walk.errors import InvalidInput, PreviewWalkError

LARGEST_TOML = 10_000_000
"""Bytes of a file of options or of a study."""

LONG = 300
"""Longest path (characters) that a sentence has in full."""

_PART = ".part-"
"""How temporary names begin; the number of the process that writes the file follows."""


class OutputError(PreviewWalkError, OSError):
    """A result that could not be written; says which file and why."""

    def __str__(self) -> str:
        """Return the sentence alone, without OSError's number."""
        return str(self.args[0])


def as_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a file or folder.

    Raises:
        InvalidInput: it is no path.
    """
    try:
        found = Path(path)
    except TypeError:
        found = Path("\0")
    if "\0" in str(found):
        from preview_walk.arguments import shown  # with NumPy, which the command loads late

        raise InvalidInput(f"a file's name must be a path, got {shown(path)}.", argument="path")
    return found


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Return whether there is a folder of this name; a name too long for one names none.

    Raises:
        InvalidInput: it is no path.
    """
    try:
        return as_path(path).is_dir()
    except OSError:
        return False


def short(path: Path) -> str:
    """Return how a sentence names a path: its end, where it is very long."""
    name = str(path)
    return name if len(name) <= LONG else f"(and more){name[-60:]}"


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Return what a TOML file holds.

    Raises:
        InvalidInput: it cannot be read, is larger than `LARGEST_TOML`, or is no TOML.
    """
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    place = as_path(path)
    try:
        if place.stat().st_size > LARGEST_TOML:
            raise InvalidInput(f"{short(place)} is too large, more than {LARGEST_TOML} bytes.")
        found: dict[str, Any] = tomllib.loads(place.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidInput(f"cannot read {short(place)}: {error.strerror}.") from None
    except InvalidInput:
        raise
    except (ValueError, RecursionError) as error:
        raise InvalidInput(f"{short(place)} is no TOML: {error}.") from None
    return found


@contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary path beside `path`; put it in place of `path` once it is whole.

    The temporary name keeps the suffix, which tells picture and video writers the format. The
    folder must exist. Whatever ends the block early (an error, Ctrl-C) removes the temporary file
    and leaves an older `path` as it was.

    Raises:
        InvalidInput: it is no path.
        OutputError: the file cannot be written (folder missing, no permission, disk full).
    """
    target = as_path(path)
    part = target.with_name(f"{_PART}{os.getpid()}-{target.name}")
    try:
        yield part
        # On disk before it takes the name: some file systems report a full disk only here.
        with open(part, "rb+") as file:
            os.fsync(file.fileno())
        os.replace(part, target)
    except OSError as error:
        reason = error.strerror or str(error)
        raise OutputError(f"cannot write {short(target)}: {reason}.") from error
    finally:
        with suppress(OSError, ValueError):
            part.unlink()


@contextmanager
def claimed(folder: Path) -> Iterator[None]:
    """Keep a folder for this run until the end of the block.

    The system lets go of it when the process ends, however that is; where it has no such locks
    (Windows, some network drives) nothing is kept.

    Raises:
        OutputError: another run has it.
    """
    try:
        import fcntl

        lock = os.open(folder, os.O_RDONLY)
    except (ImportError, OSError):
        yield
        return
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(lock)
        raise OutputError(f"another run is about to write to the folder {folder}.") from error
    except OSError:
        pass
    try:
        yield
    finally:
        os.close(lock)


def make_folder(folder: Path, names: Iterable[str]) -> None:
    """Make the folder for files of these names, and clear away what a killed run left in it.

    Raises:
        OutputError: it cannot be made or written to, or a name is taken by a folder.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {folder}: {error.strerror}.") from error
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(f"cannot write to the folder {folder}: Permission denied.")
    for name in names:
        if (folder / name).is_dir():
            raise OutputError(f"cannot write {folder / name}: Is a directory.")
    remove_stale_parts(folder)


def remove_stale_parts(folder: str | os.PathLike[str]) -> None:
    """Remove from a folder the temporary files of processes that were killed.

    Those of processes that live stay, and so does what cannot be removed.
    """
    for part in Path(folder).glob(f"{_PART}*-*"):
        number = part.name.removeprefix(_PART).split("-")[0]
        if number.isdecimal() and not _lives(int(number)):
            with suppress(OSError):
                part.unlink()


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:  # it belongs to somebody else
        return True
    return True
