"""`preview-walk --web` as a process: it tells its address, and Ctrl-C ends it and writes all."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from pathlib import Path

from preview_walk.record.record import Record

CODE = "import sys; from preview_walk.cli.main import main; sys.exit(main(sys.argv[1:]))"


def interruptible() -> None:
    """Undo `nohup` and `&`, under which Ctrl-C is ignored."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_ctrl_c_ends_the_page_and_the_record_is_written(tmp_path: Path) -> None:
    line = "--web --port 0 --robot humanoid-walker --steps 2 --no-plots --out walk"
    command = subprocess.Popen(
        [sys.executable, "-c", CODE, *line.split()],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=interruptible,
    )
    assert command.stderr is not None
    while not re.search(r"^See http://127\.0\.0\.1:\d+ in a browser", command.stderr.readline()):
        assert command.poll() is None
    said = ""
    while "walking" not in said:  # the loop has begun
        said += command.stderr.read(1)
        assert command.poll() is None
    command.send_signal(signal.SIGINT)
    output, errors = command.communicate(timeout=60)
    assert command.returncode == 130, errors
    assert output.startswith("Stopped by Ctrl-C after 0.00 s")
    assert "Traceback" not in errors
    assert {path.name for path in (tmp_path / "walk").iterdir()} == {
        "record.npz",
        "summary.json",
        "run.toml",
    }
    assert Record.load(tmp_path / "walk/record.npz").run.interrupted
