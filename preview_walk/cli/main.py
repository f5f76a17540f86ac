"""The command `preview-walk`: options in, an exit code out."""

from __future__ import annotations

import re
import shlex
import sys
import traceback
from collections.abc import Sequence

from preview_walk.cli.interruption import Interruption
from preview_walk.cli.options import Options, parse
from preview_walk.cli.streams import complain, safe_streams, say
from preview_walk.cli.words import WORDS
from preview_walk.errors import PreviewWalkError
from preview_walk.files import OutputError

WALKED, FELL, BAD_INPUT, BUG = 0, 1, 2, 3
"""Exit codes; one more says which signal stopped the command (see `Interruption`)."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command with `argv` (default: the process's); return the exit code."""
    with safe_streams() as output, Interruption() as interruption:
        try:
            code = _guarded(argv, interruption)
        except SystemExit as end:  # of --help, --version and bad options
            if output.failure is None or end.code:
                raise
            code = WALKED
        if output.failure is not None and code in (WALKED, FELL):
            complain(f"stdout: cannot be written: {output.failure.strerror}.")
            code = BAD_INPUT
        return code


def _guarded(argv: Sequence[str] | None, interruption: Interruption) -> int:
    """Do what the options ask for; every error is a sentence and a code."""
    try:
        arguments = list(sys.argv[1:] if argv is None else argv)
        if arguments and arguments[0] in WORDS:
            return WORDS[arguments[0]](arguments[1:], interruption)
        options = parse(arguments)
        command = shlex.join(["preview-walk", *arguments])
        return _do(options, command, interruption)
    except OutputError as error:
        reason = str(error).rstrip(".")
        complain(f"--out: {reason}; choose a folder that can be written, with space left.")
        return BAD_INPUT
    except PreviewWalkError as error:
        complain(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        complain(f"stopped by {interruption.name}.")
        return interruption.exit_code
    except Exception as error:
        return _unforeseen(error)


def _do(options: Options, command: str, interruption: Interruption) -> int:
    if options.list_robots:
        from preview_walk.robots.listing import list_robots

        say(list_robots())
        return WALKED
    if options.inspect is not None:
        from preview_walk.cli.inspect_model import inspect_model

        return WALKED if inspect_model(options.inspect, options.out) else BAD_INPUT
    from preview_walk.cli.run import run

    record = run(options, command, interruption)
    if interruption.received or record.run.interrupted:
        return interruption.exit_code
    return FELL if record.run.fell else WALKED


def _unforeseen(error: Exception) -> int:
    """Say what the system lacked, if that is it; else show where the error is, for it is ours."""
    missing = re.match(r"(lib[\w.+-]+): cannot open shared object file: No such", str(error))
    if isinstance(error, ImportError) and missing is not None:
        library = missing.group(1)
        complain(f"{library} is missing; on Debian or Ubuntu sudo apt install libgomp1 helps.")
        return BUG
    if isinstance(error, OSError | MemoryError):
        reason = getattr(error, "strerror", None) or str(error) or "out of memory"
        complain(f"the system does not give what the walk needs: {reason}.")
        return BAD_INPUT
    traceback.print_exception(error)
    return BUG


if __name__ == "__main__":
    raise SystemExit(main())
