"""A study as a value: what is varied, what is done with each case, how it is judged."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from inspect import getsource
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from preview_walk.arguments import LARGEST_SEED, count_of, instance_of, positive_number, shown
from preview_walk.errors import InvalidInput
from preview_walk.studies.case import Case, case_of
from preview_walk.studies.factors import (
    Draw,
    Factors,
    cells_of,
    check_factors,
    count_cells,
    named,
    names_of,
)
from preview_walk.studies.margin import Margin
from preview_walk.studies.walk_case import walk_case
from preview_walk.studies.work import Keep, Work, arguments_of

if TYPE_CHECKING:
    from preview_walk.studies.results import Results

MOST_CASES = 10_000_000


@dataclass(frozen=True)
class Study:
    """A function of keyword arguments over the cases of some factors.

    Attributes:
        factors: levels by the names of the function's arguments, whose product is the grid: a list
            of values, a frozen distribution of `scipy.stats` to draw from, or one value for all
            cases. Or a list of rows by name, one a cell.
        function: from a case to its figures: a mapping by name, a number, or a `Record`, of which
            the summary's are taken. `success` among them tells whether the case succeeded. It must
            pickle, lambdas and what a notebook defines too; it is given the case's seed if it takes
            `seed`. The default walks: `walk_case`.
        repeats: how many cases each cell has, each with draws and a seed of its own.
        seed: of the study, from which all others follow by `SeedSequence`.
        margin: look in each case for the largest value of one more factor that is survived.
        metrics: further figures by name, functions of what the function returned.
        time_limit: of a case, s; None: none.
        keep: whose records are kept in the folder: "none", "failed" or "all".
        name: of the study.

    Raises:
        InvalidInput: a value that cannot be, or factors that the function does not take.
    """

    factors: Factors
    function: Callable[..., Any] = walk_case
    repeats: int = 1
    seed: int = 0
    margin: Margin | None = None
    metrics: Mapping[str, Callable[[Any], Any]] = field(default_factory=dict)
    time_limit: float | None = None
    keep: Keep = "none"
    name: str = "study"

    def __post_init__(self) -> None:
        """Check the values, and the factors against the function."""
        if not callable(self.function):
            raise InvalidInput(
                f"function must be one, got {shown(self.function)}.", argument="function"
            )
        check_factors(self.factors)
        if count_of(self.repeats, "repeats") < 1:
            raise InvalidInput("repeats must be at least 1, got 0.", argument="repeats")
        count_of(self.seed, "seed", LARGEST_SEED)
        if self.time_limit is not None:
            positive_number(self.time_limit, "time_limit", "s")
        if self.keep not in get_args(Keep):
            kinds = ", ".join(get_args(Keep))
            raise InvalidInput(
                f"keep must be one of {kinds}, got {shown(self.keep)}.", argument="keep"
            )
        if self.margin is not None:
            instance_of(self.margin, Margin, "margin")
        if not isinstance(self.metrics, Mapping):
            raise InvalidInput(
                f"metrics must be functions by name, got {shown(self.metrics)}.",
                argument="metrics",
            )
        instance_of(self.name, str, "name")
        self._check_arguments()
        if len(self) > MOST_CASES:
            raise InvalidInput(
                f"a study must have at most {MOST_CASES} cases, got {len(self)}.",
                argument="factors",
            )

    def __len__(self) -> int:
        """Return the number of cases."""
        return count_cells(self.factors) * self.repeats

    def __repr__(self) -> str:
        """Return one line: name, function, factors, cases."""
        factors = ", ".join(names_of(self.factors))
        return f"Study({self.name}: {_name_of(self.function)}, {len(self)} cases of {factors})"

    @property
    def draws(self) -> tuple[str, ...]:
        """Names of the random factors."""
        if not isinstance(self.factors, Mapping):
            return ()
        return tuple(name for name, levels in self.factors.items() if isinstance(levels, Draw))

    def cases(self) -> Iterator[Case]:
        """Yield all cases: the repeats of the first cell, then those of the next."""
        index = 0
        for cell in cells_of(self.factors):
            for repeat in range(self.repeats):
                yield case_of(cell, index, repeat, self.seed)
                index += 1

    def work(self, folder: Path) -> Work:
        """Return what is done with each case; records go into `folder`."""
        return Work(
            self.function, dict(self.metrics), self.margin, self.time_limit, self.keep, folder
        )

    def facts(self) -> dict[str, Any]:
        """Return what the study is, as plain values: what a row depends on, and the factors."""
        factors = self.factors
        return {
            "name": self.name,
            "function": _name_of(self.function),
            "source": _digest_of(self.function),
            "metrics": {name: _digest_of(metric) for name, metric in self.metrics.items()},
            "seed": self.seed,
            "margin": None if self.margin is None else repr(self.margin),
            "repeats": self.repeats,
            "names": list(names_of(factors)),
            "draws": list(self.draws),
            "factors": {name: named(levels) for name, levels in factors.items()}
            if isinstance(factors, Mapping)
            else f"{len(factors)} rows",
        }

    def run(
        self,
        folder: str | os.PathLike[str],
        *,
        jobs: int | None = None,
        resume: bool = False,
        limit: int | None = None,
        scheduler: str | None = None,
        progress: bool = True,
    ) -> Results:
        """Do the cases; return what came out, which is in the folder too.

        A row is on disk as soon as its case ends. Stopped in whatever way and started again with
        `resume`, no case is done twice and none is lost; cases that an error, a time limit or a
        worker's end kept from their figures stay as they are.

        Args:
            folder: of the results; made if it is not there.
            jobs: processes on this machine; None: one a core.
            resume: whether to go on with rows that are in the folder.
            limit: do at most so many cases now.
            scheduler: address of a Dask scheduler whose workers do the cases instead.
            progress: show a bar on stderr.

        Raises:
            InvalidInput: the folder holds rows and `resume` is False, or rows of another study; no
                such scheduler; the function does not pickle.
            OutputError: the folder cannot be written.
        """
        from preview_walk.studies.campaign import run_study

        return run_study(
            self,
            folder,
            jobs=jobs,
            resume=resume,
            limit=limit,
            scheduler=scheduler,
            progress=progress,
        )

    def _check_arguments(self) -> None:
        """Check that the function takes the factors, and that they are all that it needs."""
        must, takes, anything = arguments_of(self.function)
        given = {*names_of(self.factors), *([self.margin.factor] if self.margin else [])}
        name = _name_of(self.function)
        unknown = sorted(given - takes)
        if unknown and not anything:
            raise InvalidInput(
                f"factors must be arguments of {name}, which takes {', '.join(sorted(takes))}; "
                f"got {', '.join(unknown)}.",
                argument="factors",
            )
        missing = sorted(must - given - {"seed"})
        if missing:
            raise InvalidInput(
                f"factors must give {name} its {', '.join(missing)} too.", argument="factors"
            )


def _name_of(function: Callable[..., Any]) -> str:
    return str(getattr(function, "__qualname__", type(function).__qualname__))


def _digest_of(function: Callable[..., Any]) -> str:
    """Return a short digest of a function's source, "" where there is none."""
    try:
        return sha256(getsource(function).encode()).hexdigest()[:16]
    except (OSError, TypeError):
        return ""
