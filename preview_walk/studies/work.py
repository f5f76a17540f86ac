"""What a worker does: one case, whatever becomes of it, as one row."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import datetime, timezone
from inspect import signature
from pathlib import Path
from platform import node
from time import perf_counter
from typing import Any, Literal, Protocol, TypeAlias

from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError
from preview_walk.record.record import Record
from preview_walk.studies.case import Case
from preview_walk.studies.figures import SUCCESS, figures_of, storable, succeeded
from preview_walk.studies.margin import Margin, largest
from preview_walk.studies.time_limit import OverTime, TimeLimit
from preview_walk.threads import one_thread

Keep: TypeAlias = Literal["none", "failed", "all"]
"""Which cases' records are kept."""

Outcome: TypeAlias = Literal["done", "error", "timeout", "killed"]
"""How a case ended: with figures; by an exception; over its time; with its worker."""


@dataclass(frozen=True)
class Work:
    """What is done with every case, sent to the workers.

    Attributes:
        function: of the case's values by keyword, and of `seed` if it takes one.
        metrics: further figures, functions of what it returns.
        margin: what is looked for by bisection, or None.
        time_limit: of a case, s; None: none.
        keep: whose records are kept.
        folder: where they are kept.
    """

    function: Callable[..., Any]
    metrics: Mapping[str, Callable[[Any], Any]] = field(default_factory=dict)
    margin: Margin | None = None
    time_limit: float | None = None
    keep: Keep = "none"
    folder: Path = Path()


class Campaign(Protocol):
    """What doing a study and reading its results need to know of it; `Study` is one."""

    @property
    def name(self) -> str:
        """Of the study."""

    @property
    def draws(self) -> tuple[str, ...]:
        """Names of the random factors."""

    def cases(self) -> Iterator[Case]:
        """Yield all cases."""

    def work(self, folder: Path) -> Work:
        """Return what is done with each case; records go into `folder`."""

    def facts(self) -> dict[str, Any]:
        """Return what the study is, as plain values."""

    def __len__(self) -> int:
        """Return the number of cases."""


@dataclass(frozen=True)
class Row:
    """What came of a case.

    Attributes:
        case: which one.
        outcome: how it ended.
        reason: why it did not succeed, in words; "" where it did or where figures tell.
        figures: plain values by name; none where it did not end by itself.
        seconds: that it took.
        started: when, ISO 8601, UTC.
        host: name of the machine.
    """

    case: Case
    outcome: Outcome
    reason: str = ""
    figures: Mapping[str, Any] = field(default_factory=dict)
    seconds: float = 0.0
    started: str = ""
    host: str = ""

    @property
    def success(self) -> bool:
        """Whether the case ended by itself, and well."""
        return self.outcome == "done" and succeeded(self.figures)


def run_case(work: Work, case: Case) -> Row:
    """Do one case; return its row, whatever becomes of it."""
    began = perf_counter()
    figures: Mapping[str, Any] = {}
    outcome: Outcome = "done"
    reason = ""
    started = datetime.now(timezone.utc).isoformat(timespec="milliseconds")
    try:
        with one_thread(), TimeLimit(work.time_limit):
            figures = _figures(work, case)
    except OverTime:
        outcome, reason = "timeout", f"over the time limit of {work.time_limit:g} s"
    except (Exception, SystemExit) as error:
        outcome, reason = "error", _told(error)
    return Row(case, outcome, reason, figures, perf_counter() - began, started, node())


def arguments_of(function: Callable[..., Any]) -> tuple[set[str], set[str], bool]:
    """Return the names that a function must get, those that it takes, and whether it takes any.

    Raises:
        InvalidInput: its arguments cannot be told.
    """
    try:
        parameters = signature(function).parameters.values()
    except (TypeError, ValueError):
        raise InvalidInput(
            "a study's function must be one whose arguments Python can tell.", argument="function"
        ) from None
    named = [p for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)]
    return (
        {p.name for p in named if p.default is p.empty},
        {p.name for p in named},
        any(p.kind is p.VAR_KEYWORD for p in parameters),
    )


def _figures(work: Work, case: Case) -> Mapping[str, Any]:
    given = dict(case.values)
    if "seed" in arguments_of(work.function)[1]:
        given.setdefault("seed", case.seed)
    margin = work.margin
    if margin is None:
        return _one(work, case, given)
    factor = margin.factor
    found = largest(margin, lambda value: succeeded(_one(work, case, {**given, factor: value})))
    return {
        SUCCESS: found.margin > margin.low,
        "margin": found.margin,
        "fatal": found.fatal,
        "islands": found.islands,
        "tried": storable(found.tried),
    }


def _one(work: Work, case: Case, given: Mapping[str, Any]) -> dict[str, Any]:
    """Call the function; keep its record where that is asked for."""
    result = work.function(**given)
    figures = figures_of(result, work.metrics)
    wanted = work.keep == "all" or (work.keep == "failed" and not succeeded(figures))
    if wanted and work.margin is None and isinstance(result, Record):
        work.folder.mkdir(parents=True, exist_ok=True)
        result.save(work.folder / f"{case.key}.npz")
    return figures


def _told(error: BaseException) -> str:
    """Return an exception in one line, and where in the user's code it was raised."""
    text = f"{type(error).__name__}: {error}"
    if isinstance(error, OutputError | InvalidInput):
        return str(error)
    with suppress(Exception):
        frame = traceback.extract_tb(error.__traceback__)[-1]
        text += f" (line {frame.lineno} of {Path(frame.filename).name})"
    return " ".join(text.split())
