"""`--inspect`: the report, and the stance as a picture."""

from __future__ import annotations

from pathlib import Path

import pytest
from cli_stand_in import complaint, run

from preview_walk.robots import inspection


def test_a_model_is_inspected_and_drawn(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        inspection.Inspection, "write_picture", lambda _, path: path.write_bytes(b"a picture")
    )
    assert run(out, "--inspect", "humanoid-walker") == 0
    printed = capsys.readouterr().out
    assert "left leg: left_hip_yaw" in printed
    assert printed.endswith(f"stance and soles: {out / 'stance.png'}\n")
    assert [path.name for path in out.iterdir()] == ["stance.png"]


def test_a_model_that_cannot_stand_is_bad_input(
    out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out, "--inspect", "none.xml") == 2
    assert complaint(capsys) == "preview-walk: --inspect: the file 'none.xml' does not exist."
    assert not out.exists()


def test_a_picture_that_cannot_be_written_is_told(
    out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (out / "stance.png").mkdir(parents=True)
    assert run(out, "--inspect", "humanoid-walker") == 2
    assert "stance.png: Is a directory" in complaint(capsys)
