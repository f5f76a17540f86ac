"""Files as they lie on the disk: whether they are there, what is in them."""

from __future__ import annotations

import re
from math import prod
from pathlib import Path

from preview_walk.errors import RobotError
from preview_walk.robots.bounds import MOST_COPIES

_COPIES = re.compile(rb"<(?:replicate|composite|flexcomp)\b[^>]*?\bcount\s*=\s*[\"']([^\"']*)")
_INCLUDED = re.compile(rb"<include\b[^>]*?\bfile\s*=\s*[\"']([^\"']*)")


def is_there(path: Path) -> bool:
    """Return whether a path names a file; a name that no file can have names none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def shown(path: str | Path) -> str:
    """Return a name or path to be read in a sentence, shortened where nobody would read it."""
    text = str(path)
    return text if len(text) <= 300 else f"{text[:140]}...{text[-140:]}"


def content_of(path: Path) -> bytes:
    """Return the bytes of a model file.

    Raises:
        RobotError: the file cannot be read.
    """
    try:
        return path.read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise RobotError(f"cannot read '{path}': {reason}", argument="model") from error


def refuse_endless(path: Path, content: bytes) -> None:
    """Look for parts that an MJCF file asks to copy, before MuJoCo copies them.

    Args:
        path: the file, beside which its includes are looked for.
        content: its bytes.

    Raises:
        RobotError: it asks for more copies than can be made in a few seconds.
    """
    seen, waiting, copies = {path}, [content], 1
    while waiting:
        text = waiting.pop()
        for count in _COPIES.findall(text):
            numbers = [int(n) for n in re.findall(rb"\d+", count)[:4]]
            copies *= max(1, prod(numbers))
        for name in _INCLUDED.findall(text):
            file = path.parent / name.decode(errors="replace")
            if file not in seen and len(seen) < 100 and is_there(file):
                seen.add(file)
                waiting.append(content_of(file))
    if copies > MOST_COPIES:
        raise RobotError(
            f"'{path}' asks for {copies:g} copies of its parts; at most {MOST_COPIES} are made",
            argument="model",
        )
