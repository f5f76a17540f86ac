"""The command as a process of its own: its streams, its signals, what a killed one leaves behind.

A stand-in takes the place of the simulation: one tick of it lasts a hundredth of a second.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from preview_walk.record.record import Record

STAND_IN = """
import sys, time
from types import SimpleNamespace
from synthetic_walk import walk_record
import preview_walk as pw
from preview_walk.analysis import plots
from preview_walk.cli import run
from preview_walk.cli.main import main
from preview_walk.record import record

TICKS = {ticks}

def simulate(robot, plan, progress=None, **_):
    stopped = False
    try:
        for i in range(TICKS):
            if i > 2:
                progress(0.1 * i, 0.1 * TICKS)
            print("tick", file=sys.__stderr__, flush=True)
            time.sleep(0.01)
    except KeyboardInterrupt:
        stopped = True
    return walk_record(4, plan=plan, interrupted=stopped)

def save(self, path, save=record.Record.save):
    print("saving", file=sys.__stderr__, flush=True)
    time.sleep({save})
    return save(self, path)

def draw(*arguments):
    print("drawing", file=sys.__stderr__, flush=True)
    time.sleep({draw})
    arguments[-1].write_bytes(b"a picture")

pw.simulate, plots.plot, record.Record.save = simulate, draw, save
pw.load_robot = lambda name: SimpleNamespace(name=name, step_width=0.17, leg_length=0.87)
run.usual_planner = lambda robot: pw.FootstepPlanner(0.25, 0.17, 0.9)
sys.exit(main(sys.argv[1:]))
"""

Start = Callable[..., "subprocess.Popen[bytes]"]


@pytest.fixture
def start(tmp_path: Path) -> Start:
    """Return a starter of the command with the stand-in, in a folder of its own."""
    here = Path(__file__).parents[2]
    paths = os.pathsep.join([str(here), str(here / "tests")])
    environment = {**os.environ, "PYTHONPATH": paths, "PYTHONIOENCODING": ""}

    def begin(
        *arguments: str | bytes, ticks: int = 5, save: float = 0.0, draw: float = 0.0
    ) -> subprocess.Popen[bytes]:
        code = STAND_IN.format(ticks=ticks, save=save, draw=draw)
        return subprocess.Popen(
            [sys.executable, "-c", code, "--steps", "4", *arguments],
            cwd=tmp_path,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    return begin


def shell(line: str, folder: Path) -> subprocess.CompletedProcess[bytes]:
    """Run the real command in a shell, with `$WALK` for it."""
    here = Path(__file__).parents[2]
    environment = {
        **os.environ,
        "PYTHONPATH": str(here),
        "WALK": f"{sys.executable} -m preview_walk",
    }
    return subprocess.run(
        ["bash", "-c", line], cwd=folder, env=environment, capture_output=True, check=False
    )


def wait_for(process: subprocess.Popen[bytes], word: bytes) -> None:
    """Read stderr until a line with the word."""
    assert process.stderr is not None
    while word not in (line := process.stderr.readline()):
        assert line, f"{word!r} never came"


def files(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


@pytest.mark.parametrize(
    ("number", "name", "code"),
    [
        (signal.SIGINT, "Ctrl-C", 130),
        (signal.SIGTERM, "SIGTERM", 143),
        (signal.SIGHUP, "SIGHUP", 129),
    ],
)
@pytest.mark.parametrize("tick", [1, 10])
def test_a_signal_ends_the_walk_and_the_walk_so_far_is_written(
    number: signal.Signals, name: str, code: int, tick: int, start: Start, tmp_path: Path
) -> None:
    process = start(ticks=3000)
    for _ in range(tick):
        wait_for(process, b"tick")
    process.send_signal(number)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == code
    assert output.startswith(f"Stopped by {name} after ".encode())
    assert Record.load(tmp_path / "walk/record.npz").run.interrupted
    assert len(files(tmp_path / "walk")) == 4


def test_signals_while_the_record_is_written_do_not_lose_it(start: Start, tmp_path: Path) -> None:
    process = start(ticks=3000, save=1.0)
    wait_for(process, b"tick")
    process.send_signal(signal.SIGINT)
    wait_for(process, b"saving")
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert files(tmp_path / "walk") == {"record.npz", "summary.json", "run.toml"}
    assert output.endswith(b"Written to walk: record.npz, summary.json, run.toml\n")
    assert b"stopped by Ctrl-C while writing" in errors
    assert Record.load(tmp_path / "walk/record.npz").run.interrupted


def test_a_signal_while_pictures_are_drawn_keeps_what_is_ready(
    start: Start, tmp_path: Path
) -> None:
    process = start(draw=0.5)
    wait_for(process, b"drawing")
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == 143
    assert files(tmp_path / "walk") == {"record.npz", "summary.json", "run.toml"}
    assert not Record.load(tmp_path / "walk/record.npz").run.interrupted


def test_a_signal_that_is_ignored_stays_so(start: Start, tmp_path: Path) -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does; children inherit it
    try:
        process = start(ticks=50)
    finally:
        signal.signal(signal.SIGHUP, before)
    wait_for(process, b"tick")
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=60)
    assert process.returncode == 0


def test_what_a_killed_run_leaves_the_next_removes(start: Start, tmp_path: Path) -> None:
    process = start(save=30.0)
    wait_for(process, b"saving")
    walk = tmp_path / "walk"
    stale = walk / f".part-{process.pid}-record.npz"
    stale.write_bytes(b"half a record")
    own = walk / f".part-{os.getpid()}-record.npz"
    own.write_bytes(b"of a process that lives")
    process.kill()
    process.communicate(timeout=60)
    assert start("--no-plots").wait(60) == 0
    assert files(walk) == {"record.npz", "summary.json", "run.toml", own.name}


def test_a_name_that_is_not_utf_8_is_a_name(start: Start, tmp_path: Path) -> None:
    process = start("--no-plots", "--out", b"w\xff\xe4lk")
    output, errors = process.communicate(timeout=60)
    assert process.returncode == 0, errors
    folder = tmp_path / os.fsdecode(b"w\xff\xe4lk")
    assert files(folder) == {"record.npz", "summary.json", "run.toml"}
    assert b"\\udcff" in output
    assert os.fsdecode(b"w\xff\xe4lk") in Record.load(folder / "record.npz").run.command


def test_full_and_closed_streams_of_a_table(tmp_path: Path) -> None:
    done = shell("$WALK --list-robots > /dev/full", tmp_path)
    assert done.returncode == 2
    assert done.stderr == b"preview-walk: stdout: cannot be written: No space left on device.\n"
    for line, code in (
        ("$WALK --version > /dev/full", 2),
        ("$WALK --version >&-", 0),
        ("$WALK --steps 0 2>&-", 2),
        ("$WALK --steps 0 2> /dev/full", 2),
        ("$WALK --version | true; exit ${PIPESTATUS[0]}", 0),
        ("$WALK --version <&- >&- 2>&-", 0),
    ):
        done = shell(line, tmp_path)
        assert done.returncode == code, line
        assert b"Traceback" not in done.stderr, line
        assert b"Exception" not in done.stderr, line


@pytest.mark.parametrize(
    ("streams", "code"),
    [("2> /dev/full", 0), ("2>&-", 0), ("> /dev/full", 2), ("<&- >&- 2>&-", 0)],
)
def test_a_walk_is_written_whatever_becomes_of_its_streams(
    streams: str, code: int, tmp_path: Path
) -> None:
    line = f"$WALK --robot humanoid-walker --steps 1 --step-time 0.6 --no-plots {streams}"
    done = shell(line, tmp_path)
    assert done.returncode == code, done.stderr
    assert files(tmp_path / "walk") == {"record.npz", "summary.json", "run.toml"}
    assert len(Record.load(tmp_path / "walk/record.npz")) > 1000


def test_the_version_is_told(tmp_path: Path) -> None:
    import preview_walk

    done = shell("$WALK --version", tmp_path)
    assert done.stdout.decode() == f"preview-walk {preview_walk.__version__}\n"


def test_rates_at_which_nothing_balances_are_refused(tmp_path: Path) -> None:
    for rates, sentence in (
        ("--physics-hz 1 --control-hz 1", b"--control-hz: control_hz must be at least 50, "),
        ("--physics-hz 100000 --control-hz 1", b"--control-hz: control_hz must be at least 50, "),
        ("--physics-hz 50 --control-hz 50", b"--physics-hz: physics_hz must be at least 100 "),
        ("--physics-hz 300", b"--physics-hz: physics_hz must be a positive multiple"),
    ):
        done = shell(f"$WALK --robot humanoid-walker {rates}", tmp_path)
        assert done.returncode == 2
        assert done.stderr.startswith(b"preview-walk: " + sentence), done.stderr
        assert len(done.stderr.splitlines()) == 1


def test_two_runs_in_one_folder(start: Start, tmp_path: Path) -> None:
    """The second is told at once; after the end of the first, even a violent one, it is free."""
    first = start("--no-plots", ticks=3000)
    wait_for(first, b"tick")
    second = start("--no-plots")
    _, errors = second.communicate(timeout=60)
    assert second.returncode == 2
    assert errors == (
        b"preview-walk: --out: another run is about to write to the folder walk; "
        b"choose a folder that can be written, with space left.\n"
    )
    first.kill()
    first.communicate(timeout=60)
    assert start("--no-plots").wait(60) == 0
    assert files(tmp_path / "walk") == {"record.npz", "summary.json", "run.toml"}


def test_a_killed_walk_leaves_its_record_and_the_next_takes_its_place(tmp_path: Path) -> None:
    """The real command, killed after its first block; then walked to the end in the same folder."""
    here = str(Path(__file__).parents[2])
    command = [sys.executable, "-m", "preview_walk", "--quiet", "--no-plots"]
    how = {"cwd": tmp_path, "env": {**os.environ, "PYTHONPATH": here}}
    process = subprocess.Popen([*command, "--steps", "40", "--record-hz", "100"], **how)
    block = tmp_path / "walk" / "record.blocks" / "000000.npz"
    until = time.monotonic() + 120.0
    while not block.exists() and time.monotonic() < until:
        time.sleep(0.02)
    process.kill()
    process.wait()
    left = Record.load(block.parent)
    assert len(left) >= 500
    assert left.run.interrupted
    assert left.dt == pytest.approx(0.01)
    plotted = [sys.executable, "-m", "preview_walk", "plot", "walk/record.blocks"]
    done = subprocess.run(plotted, capture_output=True, text=True, check=True, **how)
    assert "did not fall" in done.stdout
    assert (tmp_path / "walk" / "walk.png").exists()
    subprocess.run([*command, "--steps", "2"], check=True, **how)
    names = {path.name for path in (tmp_path / "walk").iterdir()}
    assert names == {"record.npz", "summary.json", "run.toml"}
