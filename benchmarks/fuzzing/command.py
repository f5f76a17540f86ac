"""Command lines; a walk that is accepted is stopped after its first ticks."""

from __future__ import annotations

import contextlib
import io
from functools import lru_cache
from pathlib import Path
from random import Random

from fuzzing.verdict import ACCEPTED, FAILED, REFUSED, Verdict, of_error, sentence_flaw

ODD = (
    "0", "-0", "1", "-1", "2", "3.5", "1e308", "-1e308", "5e-324", "nan", "inf", "-inf", "", " ",
    "text", "0x10", "1_000", "\u0663", "\u221e", "1e400", "+5", " 1", "1 ", "1,2", "1,2,3",
    "0,0,0", "0.3,0,20", "nan,0,0", "1e308,1e308,1e308", ",,", "1,2,3,4,5", "0.5,0.2,10,0,0",
    "1,0.1,1e5,0,0", "1,0.1,inf,0,0", "every=1,impulse=5", "every=1", "every=nan,impulse=1",
    "every=1,impulse=1e9", "impulse=1,every=1,every=2", "=", "true", "None", "x" * 5000, "\udcff",
    "--steps", "--", "-", "99999999999999999999", "1e-9", "100", "1000", "500", "100000",
)  # fmt: skip
GOOD = {
    "--steps": ("1", "2", "30"), "--step-length": ("0.1", "-0.1", "0.4"), "--step-time": ("0.9",
    "0.5"),
    "--double-support-ratio": ("0.2", "0.5"), "--turn": ("10", "-20", "60"),
    "--velocity": ("0.3,0,0", "0.1,0.1,20"), "--duration": ("2", "0.5"), "--start": ("1,2,30",),
    "--friction": ("0.5", "1"), "--push": ("1,0.2,10,0,0",), "--pushes": ("every=1,impulse=5",),
    "--seed": ("3",), "--physics-hz": ("1000", "2000"), "--control-hz": ("500", "250"),
    "--solver": ("osqp", "daqp"), "--robot": ("humanoid-walker", "g1", "nobody"),
    "--out": ("walk", "a/b", "."), "--inspect": ("humanoid-walker", "nobody"),
}  # fmt: skip
PATHS = ("nowhere.urdf", "/dev/null", "/dev/full", "/proc/self/mem", "a\nb", "/dev/null/x", "here")
FLAGS = (
    "--no-plots",
    "--video",
    "--view",
    "--list-robots",
    "--version",
    "--help",
    "--nonsense",
    "-h",
)
STOPPED = 130
"""Exit code of a walk that Ctrl-C stopped."""


def draw(rng: Random) -> list[str]:
    """Return options, each with its value, most of them odd."""
    parts = ["--robot=humanoid-walker"] if rng.random() < 0.7 else []
    for _ in range(rng.randint(1, 5)):
        option = rng.choice(sorted(GOOD))
        if rng.random() < 0.06:
            parts.append(rng.choice(FLAGS))
            continue
        values = ODD if rng.random() < 0.6 else GOOD[option]
        if option in ("--robot", "--inspect", "--out") and rng.random() < 0.5:
            values = PATHS
        join = "=" if rng.random() < 0.5 else "\x1f"
        parts.append(f"{option}{join}{rng.choice(values)}")
    return [*parts, "--no-plots"]


@lru_cache(maxsize=1)
def _cut_walks() -> None:
    """Let every walk of this process be stopped, as by Ctrl-C, when it first tells its progress.

    The command runs a walk to its end, which is not what is tried here.
    """
    from preview_walk import Walk

    usual = Walk.run

    def few(walk: Walk, until: float | None = None, progress: object = None) -> Walk:
        return usual(walk, until, _stop)

    Walk.run = few  # type: ignore[method-assign, assignment]


def _stop(time: float, end: float) -> None:
    raise KeyboardInterrupt


def attempt(parts: list[str], folder: Path) -> Verdict:
    """Run the command and look at its exit code and at what it says."""
    from preview_walk.cli.main import main

    _cut_walks()
    (folder / "here").mkdir()
    arguments = [word for part in parts for word in part.split("\x1f")]
    out, err = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(arguments)
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    except BaseException as error:
        return of_error(error)
    said = err.getvalue()
    if code in (0, 1, STOPPED):
        return Verdict(ACCEPTED)
    if code != 2:
        last = said.strip().splitlines()[-1:] or [""]
        return Verdict(
            FAILED, f"exit code {code}: {last[0][:200]}", f"exit code {code}: {last[0][:60]}"
        )
    lines = said.strip("\n").split("\n")
    flaw = sentence_flaw("\n".join(lines)) or (
        "" if said.startswith("preview-walk: ") else "no name"
    )
    if flaw and "--help" not in said:
        return Verdict(FAILED, f"{flaw}: {said[:200]!r}", f"{flaw}: {said[:60]!r}")
    return Verdict(REFUSED, said[:200])
