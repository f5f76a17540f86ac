"""What may become of a case: accepted, refused in one sentence, or a failure."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

from preview_walk.errors import InvalidInput, PreviewWalkError

LONGEST = 2000
"""Most characters of a sentence."""

ACCEPTED, REFUSED, FAILED = "accepted", "refused", "failed"


@dataclass(frozen=True)
class Verdict:
    """What became of a case.

    Attributes:
        kind: accepted, refused or failed.
        detail: what went wrong, in one line.
        place: where, for failures of one cause to be told only once.
    """

    kind: str
    detail: str = ""
    place: str = ""


def of_error(error: BaseException, named: bool = False) -> Verdict:
    """Return the verdict on what a call raised.

    Args:
        error: what was raised.
        named: whether the argument at fault must be named.
    """
    sentence = str(error)
    if not isinstance(error, PreviewWalkError):
        return Verdict(FAILED, f"{type(error).__name__}: {sentence[:200]}", _place(error))
    flaw = sentence_flaw(sentence)
    if named and type(error) is InvalidInput and not error.argument and "fell" not in sentence:
        flaw = "no argument is named"
    if flaw:
        return Verdict(FAILED, f"{flaw}: {sentence[:200]!r}", _place(error))
    return Verdict(REFUSED, sentence[:200])


def sentence_flaw(sentence: str) -> str:
    """Return why this is not one sentence; empty where it is."""
    if not sentence.strip():
        return "nothing is said"
    if "\n" in sentence:
        return "more than one line is said"
    return "it is too long" if len(sentence) > LONGEST else ""


def _place(error: BaseException) -> str:
    """Return the innermost line of the package that an error went through."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "preview_walk" in Path(frame.filename).parts]
    last = (own or list(frames))[-1] if frames else None
    where = "" if last is None else f"{Path(last.filename).name}:{last.lineno} in {last.name}"
    return f"{type(error).__name__} at {where}"
