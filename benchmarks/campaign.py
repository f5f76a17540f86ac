"""What the benchmarks that are campaigns share: their options, the run, a sentence for bad input.

Each says what its study is and how its results read; the rest is `pw.Study`: cases on all cores or
a Dask cluster, a row on disk as soon as one ends, and `--resume` to go on after a stop.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import preview_walk as pw


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message.removeprefix('argument ')}; see --help.\n")


def make_parser(doc: str | None, folder: str) -> argparse.ArgumentParser:
    """Return a parser of the options that all of them have.

    Args:
        doc: of the benchmark; its help.
        folder: of the results, unless told otherwise.
    """
    parser = _Parser(
        description=doc, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("--jobs", type=int, help="processes (default: one a core)")
    parser.add_argument(
        "--out", type=Path, default=Path(folder), help=f"folder of the results (default {folder})"
    )
    parser.add_argument("--resume", action="store_true", help="go on with what is in the folder")
    parser.add_argument("--limit", type=int, help="do at most so many cases now")
    parser.add_argument("--scheduler", help="address of a Dask scheduler, as tcp://host:8786")
    return parser


def run(
    parser: argparse.ArgumentParser,
    study_of: Callable[[argparse.Namespace], pw.Study],
    report: Callable[[pw.Results, argparse.Namespace], int],
) -> int:
    """Do a benchmark; return its exit code: 2 for bad input, 130 where Ctrl-C stopped it.

    Args:
        parser: of its options.
        study_of: returns the study that the options ask for.
        report: prints what came out; returns the exit code.
    """
    given = parser.parse_args()
    try:
        results = study_of(given).run(
            given.out,
            jobs=given.jobs,
            resume=given.resume,
            limit=given.limit,
            scheduler=given.scheduler,
        )
    except pw.PreviewWalkError as error:
        option = "--resume: " if getattr(error, "argument", None) == "resume" else ""
        print(f"{parser.prog}: {option}{error}", file=sys.stderr)
        return 2
    for row in results.table[results.table["outcome"] != "done"].itertuples():
        print(f"case {row.Index} ended by {row.outcome}: {row.reason}")
    page = pw.write_report(results)
    code = report(results, given) if len(results) else 0
    print(f"rows, table and page: {given.out}/rows.jsonl, results.parquet, {page.name}")
    if results.missing:
        print(f"{results.missing} cases are left; the same command with --resume goes on")
    return 130 if results.interrupted else code


def scaled(values: object, scale: float, digits: int = 1) -> str:
    """Return numbers of a row times a scale, with - for those that it does not have."""
    items = values if isinstance(values, list | tuple) else [values]
    return ", ".join("-" if v is None or v != v else f"{scale * v:.{digits}f}" for v in items)
