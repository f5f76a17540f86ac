"""What the command does beside walking, by its first word."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from preview_walk.cli.interruption import Interruption
from preview_walk.cli.naming import naming
from preview_walk.cli.option_table import DEFAULT_PORT
from preview_walk.cli.parser import WordParser, make_parser
from preview_walk.cli.progress import progress_bar
from preview_walk.cli.streams import say
from preview_walk.cli.study import run_study_file
from preview_walk.cli.values import text, whole

DONE, BAD_INPUT = 0, 2
"""Exit codes."""

RECORD = "record.npz of a walk, or the record.blocks of a killed one"
"""What a record's path may be, as the help has it."""


def replay(arguments: Sequence[str], interruption: Interruption) -> int:
    """Play a record in the browser, or write it as a page or a film; return the exit code."""
    parser = WordParser("preview-walk replay", description="Play a record.", allow_abbrev=False)
    file = text("the name of a file")
    parser.add_argument("record", type=file, help=RECORD)
    parser.add_argument("--html", metavar="FILE", type=file, help="write one page instead")
    parser.add_argument("--video", metavar="FILE", type=file, help="write a film instead")
    parser.add_argument("--robot", metavar="PATH", type=file, help="if it is not in the catalogue")
    port = whole(0, 65535)
    help_port = f"of the page on this machine; 0: any (default {DEFAULT_PORT})"
    parser.add_argument("--port", metavar="N", type=port, default=DEFAULT_PORT, help=help_port)
    given = parser.parse_args(list(arguments))
    import preview_walk as pw

    record = pw.Record.load(given.record)
    with naming("--robot"):
        robot = pw.load_robot(given.robot or record.run.robot)
    if given.html:
        say(f"Written: {pw.export_html(record, given.html, robot)}")
    if given.video:
        with progress_bar("filming") as progress:
            film = pw.render_video(record, robot, given.video, progress=progress)
        say(f"Written: {film}")
    if not given.html and not given.video:
        pw.show(record, port=given.port, robot=robot)
    return DONE


def plot(arguments: Sequence[str], interruption: Interruption) -> int:
    """Print a record's figures and write its plots; return the exit code."""
    parser = WordParser("preview-walk plot", description="Draw a record.", allow_abbrev=False)
    file = text("the name of a file")
    parser.add_argument("record", type=file, help=RECORD)
    parser.add_argument("--out", metavar="DIR", type=file, help="folder (default: the record's)")
    given = parser.parse_args(list(arguments))
    import preview_walk as pw

    record = pw.Record.load(given.record)
    folder = Path(given.out) if given.out else Path(given.record).parent
    say(str(record.summary()))
    names = [pw.plot(record, folder / "walk.png"), *pw.plot_all(record, folder)]
    say(f"Written to {folder}: {', '.join(path.name for path in names)}")
    return DONE


def inspect(arguments: Sequence[str], interruption: Interruption) -> int:
    """Report on a model, as `--inspect` does; return the exit code."""
    parser = WordParser("preview-walk inspect", description="Report on a model.")
    parser.add_argument("model", type=text("a robot's name or its model's path"))
    folder = text("the name of a folder")
    parser.add_argument("--out", metavar="DIR", type=folder, default="walk", help="for the picture")
    given = parser.parse_args(list(arguments))
    from preview_walk.cli.inspect_model import inspect_model

    return DONE if inspect_model(given.model, Path(given.out)) else BAD_INPUT


def completion(arguments: Sequence[str], interruption: Interruption) -> int:
    """Print what a shell needs to complete the command's options; return the exit code."""
    import shtab

    parser = WordParser(
        "preview-walk completion",
        description='Print the completion of a shell: eval "$(preview-walk completion bash)".',
    )
    parser.add_argument("shell", choices=shtab.SUPPORTED_SHELLS)
    given = parser.parse_args(list(arguments))
    say(shtab.complete(make_parser(), given.shell))
    return DONE


WORDS: Mapping[str, Callable[[Sequence[str], Interruption], int]] = {
    "study": run_study_file,
    "replay": replay,
    "plot": plot,
    "inspect": inspect,
    "completion": completion,
}
"""What each word does with what follows it."""
