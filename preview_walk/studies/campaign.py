"""One run of a study: what is left to do, done, written, and shown on the way."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import closing
from itertools import islice
from pathlib import Path
from typing import Any

from preview_walk.arguments import count_of
from preview_walk.errors import InvalidInput
from preview_walk.extras import require
from preview_walk.files import as_path, short
from preview_walk.record.recorder import package_versions
from preview_walk.stopping import Stop
from preview_walk.studies.case import Case
from preview_walk.studies.engine import rows_of
from preview_walk.studies.journal import RECORDS, Journal, read_facts, read_rows
from preview_walk.studies.pools import ClusterPool, LocalPool, Pool
from preview_walk.studies.results import Results
from preview_walk.studies.work import Campaign

_MUST_AGREE = ("function", "source", "metrics", "seed", "margin")
"""Facts of a study on which its rows depend; factors and repeats may grow and shrink."""


class VersionsWarning(UserWarning):
    """A study goes on with other versions of its packages than its rows were made with."""


def run_study(
    study: Campaign,
    folder: str | os.PathLike[str],
    *,
    jobs: int | None,
    resume: bool,
    limit: int | None,
    scheduler: str | None,
    progress: bool,
) -> Results:
    """Do what is left of a study; the arguments and errors are those of `Study.run`."""
    require("a study", "studies", "pandas", "pyarrow", "cloudpickle")
    if jobs is not None and count_of(jobs, "jobs", 1024) < 1:
        raise InvalidInput("jobs must be at least 1, got 0.", argument="jobs")
    if limit is not None:
        count_of(limit, "limit", 2**62)
    place = as_path(folder)
    journal = Journal(place, _versions())
    with journal.open():
        done = _done(study, place, journal.versions, resume)
        _require_picklable(study)
        journal.describe({**study.facts(), "versions": journal.versions})
        left = (case for case in study.cases() if case.key not in done)
        count = sum(case.key not in done for case in study.cases()) if done else len(study)
        if count:
            pool = LocalPool(jobs) if scheduler is None else ClusterPool(scheduler)
            interrupted = _run(
                study, journal, pool, islice(left, limit), _bar(study, count, limit, progress)
            )
        else:
            interrupted = False
        results = Results.of(study, place, interrupted=interrupted)
        results.write()
    return results


def _run(study: Campaign, journal: Journal, pool: Pool, cases: Iterator[Case], bar: Any) -> bool:
    """Do cases and write their rows; return whether Ctrl-C stopped it."""
    succeeded = finished = 0
    work = study.work((journal.folder / RECORDS).resolve())
    with Stop() as stop:
        try:
            with closing(pool), bar:
                for row in rows_of(pool, work, cases, stop):
                    journal.write(row)
                    finished, succeeded = finished + 1, succeeded + row.success
                    bar.set_postfix_str(f"{succeeded / finished:.0%} succeeded", refresh=False)
                    bar.update()
        except KeyboardInterrupt:
            return True
    return stop.asked


def _done(study: Campaign, folder: Path, versions: str, resume: bool) -> set[str]:
    """Return the keys of the rows in a folder, which must be of this study."""
    facts, rows = read_facts(folder), read_rows(folder)
    if facts is None or not rows:
        return set()
    if not resume:
        raise InvalidInput(
            f"the folder {short(folder)} holds {len(rows)} cases of a study: resume it, or choose "
            "another folder.",
            argument="resume",
        )
    mine = study.facts()
    changed = [name for name in _MUST_AGREE if facts.get(name) != mine[name]]
    if changed:
        raise InvalidInput(
            f"the folder {short(folder)} holds cases of another study, whose "
            f"{' and '.join(changed)} differs: choose another folder.",
            argument="resume",
        )
    others = {str(row.get("versions")) for row in rows} - {versions}
    if others:
        warnings.warn(
            f"{sum(row.get('versions') != versions for row in rows)} cases in {short(folder)} "
            f"were done with {'; '.join(sorted(others))}, and now it is {versions}.",
            VersionsWarning,
            stacklevel=4,
        )
    return {row["key"] for row in rows}


def _bar(study: Campaign, count: int, limit: int | None, progress: bool) -> Any:
    """Return a bar with the rate and the time left."""
    from tqdm.auto import tqdm

    return tqdm(
        total=count if limit is None else min(count, limit),
        desc=study.name,
        unit="case",
        disable=not progress,
        smoothing=0.05,
        mininterval=0.1 if sys.stderr.isatty() else 5.0,
    )


def _require_picklable(study: Campaign) -> None:
    """Check that the workers can be told what to do."""
    import cloudpickle

    try:
        cloudpickle.dumps((study.work(Path()), next(iter(study.cases()))))
    except Exception as error:
        raise InvalidInput(
            f"a study's function, metrics and factors must pickle: {error}.", argument="function"
        ) from error


def _versions() -> str:
    return ", ".join(f"{name} {version}" for name, version in package_versions().items())


def cases_left(study: Campaign, folder: Path) -> Iterator[Case]:
    """Yield the cases that a run of the study into a folder would do."""
    done = {row["key"] for row in read_rows(folder)}
    return (case for case in study.cases() if case.key not in done)
