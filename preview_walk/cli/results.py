"""The folder of results: made before the walk, filled after it, most precious first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from preview_walk.analysis.names import SINGLE
from preview_walk.cli.interruption import Interruption
from preview_walk.cli.naming import naming
from preview_walk.cli.progress import progress_bar
from preview_walk.errors import PreviewWalkError
from preview_walk.files import OutputError, whole_file
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot

RECORD, SUMMARY, OVERVIEW = "record.npz", "summary.json", "walk.png"
BLOCKS = "record.blocks"
"""Folder of the record while the walk goes; what a killed walk leaves."""

FILM, PAGE, CONFIG = "walk.mp4", "walk.html", "run.toml"
Writers = Mapping[str, Callable[[Path], object]]
"""What writes each file, by its name."""


def result_names() -> tuple[str, ...]:
    """Return the names of all files that a run may write, most precious first."""
    return (RECORD, SUMMARY, CONFIG, OVERVIEW, *(f"{name}.png" for name in SINGLE), FILM, PAGE)


def writers_of(
    record: Record,
    robot: Robot,
    *,
    pictures: bool,
    film: bool,
    page: bool = False,
    quiet: bool = False,
) -> tuple[Writers, Writers]:
    """Return what writes the figures of a run, and what writes its pictures."""
    figures = {RECORD: record.save, SUMMARY: record.summary().write}
    drawn: dict[str, Callable[[Path], object]] = {}
    if pictures and len(record):
        drawn[OVERVIEW] = partial(_overview, record)
    if film and len(record):
        drawn[FILM] = partial(_film, record, robot, shown=not quiet)
    if page and len(record):
        drawn[PAGE] = partial(_page, record, robot)
    return figures, drawn


def write_results(
    folder: Path, figures: Writers, pictures: Writers, interruption: Interruption
) -> tuple[list[str], PreviewWalkError | None]:
    """Write the figures whatever signals come, then the pictures until one does.

    Returns:
        The names of the files written, and the first failure: where a disk has no room for the
        record, it may have for the figures.
    """
    interruption.hold()
    written: list[str] = []
    failure: PreviewWalkError | None = None
    try:
        for name in result_names():
            _remove(folder / name)  # nothing may stay that could be taken for a part of this run
        for name, write in {**figures, **pictures}.items():
            if name in pictures:
                interruption.release()
            try:
                write(folder / name)
                written.append(name)
            except PreviewWalkError as error:
                failure = failure or error
            interruption.hold()
    except KeyboardInterrupt:
        pass  # noted by `interruption`; what is written is whole, and stays
    return written, failure


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"cannot replace {path}: {error.strerror}.") from error


def _overview(record: Record, path: Path) -> None:
    from preview_walk.analysis.plots import plot

    plot(record, path)


def _page(record: Record, robot: Robot, path: Path) -> None:
    from preview_walk.viewer.web.export import export_html

    with naming("--web"):
        export_html(record, path, robot)


def _film(record: Record, robot: Robot, path: Path, *, shown: bool) -> None:
    from preview_walk.viewer.video import render_video

    bar = progress_bar("filming", shown=shown)
    with naming("--video"), whole_file(path) as part, bar as progress:
        render_video(record, robot, part, progress=progress)
