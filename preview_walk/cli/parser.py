"""The parser of the command line: argparse, but for one sentence when something is wrong."""

from __future__ import annotations

import argparse
import re
from difflib import get_close_matches
from typing import NoReturn

import preview_walk
from preview_walk.cli.option_table import FLAGS, OPTIONS
from preview_walk.cli.streams import complain

EXIT_CODES = """\
exit code: 0 walked and stood; 1 fell; 2 bad input or a result that could not be written;
3 an error of preview-walk itself; 130, 143 or 129 stopped by Ctrl-C, SIGTERM or SIGHUP (the
record so far is written)"""


def make_parser() -> Parser:
    """Return the parser of all options."""
    parser = Parser(
        prog="preview-walk",
        description="A humanoid walks in MuJoCo by preview control and one whole-body QP a tick.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    for option in OPTIONS:
        more = {"action": "append", "default": []} if option.repeated else {}
        parser.add_argument(
            option.name,
            metavar=option.metavar,
            type=option.reader,
            help=option.help,
            **{"default": option.default, **more},
        )
    for name, line in FLAGS.items():
        parser.add_argument(name, action="store_true", help=line)
    version = f"preview-walk {preview_walk.__version__}"
    parser.add_argument(
        "--version", action="version", version=version, help="print the version and end"
    )
    return parser


class Parser(argparse.ArgumentParser):
    """An argument parser that complains in one sentence."""

    def read(self, arguments: list[str]) -> argparse.Namespace:
        """Return the options; exit with code 2 and one sentence when they can't be read."""
        # argparse takes the dashes of `--turn=--` for the end of the options, and the value is [].
        for option in OPTIONS:
            if f"{option.name}=--" in arguments:
                self.error(f"argument {option.name}: expected one argument")
        return self.parse_args(join_negative_values(arguments))

    def error(self, message: str) -> NoReturn:
        """Print one sentence that names the option and what is allowed; exit with code 2."""
        missing = re.match(r"argument (--[\w-]+): expected one argument", message)
        unknown = re.match(r"unrecognized arguments: (\S+)", message)
        if missing:
            name = missing.group(1)
            (reader,) = (option.reader for option in OPTIONS if option.name == name)
            message = f"{name}: must be {reader.__doc__}, got nothing."
        elif unknown:
            names = [option.name for option in OPTIONS]
            known = sorted([*names, *FLAGS, "--help", "--version"])
            close = get_close_matches(unknown.group(1).split("=")[0], known, 1)
            hint = f"did you mean {close[0]}? " if close else ""
            message = f"{unknown.group(1)}: no such option; {hint}allowed are {', '.join(known)}."
        complain(message.removeprefix("argument "))
        raise SystemExit(2)


class WordParser(argparse.ArgumentParser):
    """A parser of what follows a word; it complains in one sentence."""

    def error(self, message: str) -> NoReturn:
        """Print the sentence; exit with code 2."""
        word = self.prog.split()[-1]
        message = message.removeprefix("argument ").removesuffix(".")
        complain(f"{word}: {message}; '{self.prog} --help' tells what is allowed.")
        raise SystemExit(2)


def join_negative_values(arguments: list[str]) -> list[str]:
    """Write `--start -1,0,0` as `--start=-1,0,0`, which argparse takes for an option otherwise."""
    joined: list[str] = []
    for argument in arguments:
        follows_option = bool(joined) and re.fullmatch(r"--[a-z-]+", joined[-1]) is not None
        if follows_option and re.match(r"-(\d|\.|inf|nan)", argument):
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined
