"""`preview-walk study FILE`: a campaign from a TOML file."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from preview_walk.cli.interruption import Interruption
from preview_walk.cli.naming import naming
from preview_walk.cli.parser import WordParser
from preview_walk.cli.streams import say
from preview_walk.cli.values import text, whole

ALL_ENDED, SOME_DID_NOT = 0, 1
"""Exit codes: every case ended by itself, or some by an error, their time or their worker's end."""

SHOWN = 10
"""Cases that --dry-run prints."""

_EPILOG = """\
exit code: 0 every case ended by itself; 1 some did not (an error, the time limit, a worker that
ended); 2 bad input; 130, 143 or 129 stopped by Ctrl-C, SIGTERM or SIGHUP (what is done is kept)"""


def make_parser() -> argparse.ArgumentParser:
    """Return the parser of what follows the word."""
    parser = WordParser(
        prog="preview-walk study",
        description="Run the cases of a study that a TOML file describes, on all cores or a "
        "cluster; go on where it stopped.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    file = text("the name of a TOML file")
    parser.add_argument("file", metavar="FILE.toml", type=file, help="what is to be done")
    folder = text("the name of a folder")
    parser.add_argument(
        "--out", metavar="DIR", type=folder, help="folder of the results (default: FILE)"
    )
    jobs = whole(1, 1024)
    parser.add_argument("--jobs", metavar="N", type=jobs, help="processes (default: one a core)")
    parser.add_argument(
        "--resume", action="store_true", help="go on with the cases that are in the folder"
    )
    limit = whole(0, 10**9)
    parser.add_argument("--limit", metavar="N", type=limit, help="do at most N cases now")
    parser.add_argument(
        "--dry-run", action="store_true", help="print how many cases there are, and the first ones"
    )
    address = text("the address of a Dask scheduler")
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", type=address, help="of Dask, as tcp://host:8786"
    )
    return parser


def run_study_file(arguments: Sequence[str], interruption: Interruption) -> int:
    """Do what the command line asks for; return the exit code.

    Args:
        arguments: what follows the word.
        interruption: receives the signals.

    Raises:
        PreviewWalkError: bad input, or a folder that cannot be written.
    """
    given = make_parser().parse_args(list(arguments))
    from preview_walk.studies.reading import read_study
    from preview_walk.studies.report import write_report

    study = read_study(given.file)
    folder = Path(given.out) if given.out else Path(given.file).with_suffix("")
    if given.dry_run:
        from preview_walk.studies.campaign import cases_left

        say(f"{study!r}: {sum(1 for _ in cases_left(study, folder))} of {len(study)} are left")
        for case, _ in zip(cases_left(study, folder), range(SHOWN), strict=False):
            values = ", ".join(f"{name}={value}" for name, value in case.values.items())
            say(f"  {values}, seed {case.seed}")
        return ALL_ENDED
    with naming(given.file):
        results = study.run(
            folder,
            jobs=given.jobs,
            resume=given.resume,
            limit=given.limit,
            scheduler=given.scheduler,
        )
    say(str(results))
    page = write_report(results)
    say(f"Written to {folder}: results.parquet, {page.name}")
    if results.interrupted:
        say(f"Stopped by {interruption.name}; the same command with --resume goes on.")
        return interruption.exit_code
    return ALL_ENDED if (results.table["outcome"] == "done").all() else SOME_DID_NOT
