"""Solutions kept on disk: the same bits, never a wrong one, none where none can be written."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from preview_walk.preview import kept, riccati
from preview_walk.preview.cart_table import sampled_cart_table
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.problem import Problem


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(kept, "user_cache_path", lambda _: tmp_path / "kept")
    return tmp_path / "kept"


def gains(z_c: float = 0.8) -> np.ndarray:
    return preview_gains(sampled_cart_table(z_c, 0.005), 1.0, 0.0, 1e-6, 320).preview_gain


def unsolvable(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(problem: Problem) -> None:
        raise AssertionError("solved again")

    monkeypatch.setattr(riccati, "_solved", refuse)


def test_a_kept_solution_gives_the_same_bits(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = gains()
    unsolvable(monkeypatch)
    assert np.array_equal(gains(), first)
    with pytest.raises(AssertionError, match="solved again"):
        gains(0.8 + 1e-12)


def cut(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:100])


def bend(file: Path) -> None:
    with np.load(file) as found:
        np.savez(file, key=found["key"], riccati=found["riccati"] * 1.001)


def shrink(file: Path) -> None:
    with np.load(file) as found:
        np.savez(file, key=found["key"], riccati=found["riccati"][:2])


def swap(file: Path) -> None:
    with np.load(file) as found:
        np.savez(file, key="another", riccati=found["riccati"])


@pytest.mark.parametrize("damage", [cut, bend, shrink, swap, Path.unlink])
def test_a_damaged_one_is_solved_again(folder: Path, damage: Callable[[Path], None]) -> None:
    first = gains()
    (file,) = folder.iterdir()
    damage(file)
    assert np.array_equal(gains(), first)
    with np.load(file) as found:
        assert found["riccati"].shape == (4, 4)


def test_where_nothing_can_be_written_nothing_is_kept(folder: Path) -> None:
    folder.write_text("a file in its place")
    assert len(gains()) == 320


def test_no_more_files_than_slots(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "SLOTS", 3)
    for z_c in np.linspace(0.6, 1.0, 20):
        gains(float(z_c))
    assert len(list(folder.iterdir())) <= 3


def test_a_second_start_does_not_import_control(tmp_path: Path) -> None:
    line = (
        "import sys, preview_walk as pw; pw.PreviewController();"
        "late = 'control', 'scipy.signal', 'matplotlib';"
        "print(*[name for name in late if name in sys.modules])"
    )
    places = {"XDG_CACHE_HOME": str(tmp_path), "PATH": ""}
    said = [
        subprocess.run(
            [sys.executable, "-c", line], env=places, capture_output=True, text=True, check=True
        ).stdout.split()
        for _ in range(2)
    ]
    assert said == [["control", "scipy.signal", "matplotlib"], []]
