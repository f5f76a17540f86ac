"""The file of a record, read without trust: junk of every kind is one sentence, and cheap."""

from __future__ import annotations

import io
import json
import os
import tracemalloc
import zipfile
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic_walk import walk_record

from preview_walk.analysis.plots import plot
from preview_walk.errors import InvalidInput
from preview_walk.record import file as record_file
from preview_walk.record.record import Record

PARTS = dict[str, bytes]


def refused_within_10_mb(path: Path, why: str) -> None:
    tracemalloc.start()
    with pytest.raises(InvalidInput, match=why):
        Record.load(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10e6


def npy(value: Any) -> bytes:
    """Return an array as the bytes of a .npy file."""
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, np.asarray(value), allow_pickle=True)
    return buffer.getvalue()


def header(shape: tuple[int, ...], descr: str = "<f8") -> bytes:
    """Return the header alone of a .npy file."""
    buffer = io.BytesIO()
    fields = {"descr": descr, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(buffer, fields)
    return buffer.getvalue()


def settings(text: str) -> bytes:
    return npy(np.array(text))


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory) -> PARTS:
    """Return what a short record's file holds, by name."""
    path = walk_record(2).save(tmp_path_factory.mktemp("record") / "x.npz")
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def write(path: Path, parts: PARTS) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return path


JUNK: dict[str, PARTS] = {
    "no header": {"com.npy": b""},
    "half a header": {"com.npy": header((3, 3))[:20]},
    "a header of junk": {"com.npy": b"\x93NUMPY\x01\x00\x10\x00" + b"([{" * 5 + b"\n"},
    "a version of the future": {"com.npy": b"\x93NUMPY\x09\x00" + bytes(60)},
    "a shape that lies": {"com.npy": header((10**12, 3)) + bytes(24)},
    "a shape that overflows": {"com.npy": header((2**62, 2**62)) + bytes(24)},
    "a negative shape": {"com.npy": header((-1, 3)) + bytes(24)},
    "a shape too small": {"com.npy": header((0, 3)) + bytes(24)},
    "objects": {"com.npy": npy(np.array([None, {}], dtype=object))},
    "texts": {"com.npy": npy(np.array(["a", "b"]))},
    "complex numbers": {"com.npy": npy(np.zeros((3, 3), dtype=complex))},
    "other lengths": {"com.npy": npy(np.zeros((3, 3)))},
    "a number": {"time.npy": npy(1.0)},
    "time in a table": {"time.npy": npy(np.zeros((5, 5)))},
    "phases that are no codes": {"phase.npy": npy(np.full(7, 0.5))},
    "odd plan": {"step_lift.npy": npy(np.zeros(3))},
    "keeps what was not there": {"plan_kept.npy": npy(np.array([7]))},
    "no text": {"settings.npy": npy(np.zeros(3))},
    "empty text": {"settings.npy": settings("")},
    "a list": {"settings.npy": settings("[1, 2]")},
    "a number's settings": {"settings.npy": settings("3")},
    "no format": {"settings.npy": settings('{"control_hz": 500}')},
    "format in words": {"settings.npy": settings('{"format": "one", "control_hz": 500}')},
    "no rate": {"settings.npy": settings('{"format": 1}')},
    "a rate of zero": {"settings.npy": settings('{"format": 1, "control_hz": 0}')},
    "heavy": {"settings.npy": settings('{"format": 1, "control_hz": 500, "mass": "heavy"}')},
    "deep": {"settings.npy": settings('{"gains":' * 90000 + "0" + "}" * 90000)},
    "deep enough for JSON": {
        "settings.npy": settings(
            '{"format": 1, "control_hz": 500, "gains": ' + '{"a":' * 900 + "0" + "}" * 900 + "}"
        )
    },
}


@pytest.mark.parametrize("kind", JUNK)
def test_junk_in_one_array_gets_one_sentence(kind: str, parts: PARTS, tmp_path: Path) -> None:
    path = write(tmp_path / "x.npz", {**parts, **JUNK[kind]})
    with pytest.raises(InvalidInput, match=r"x\.npz is not a record written by") as e:
        Record.load(path)
    assert e.value.argument == "path"
    assert len(str(e.value).splitlines()) == 1


def test_what_a_file_holds_besides_is_not_read(parts: PARTS, tmp_path: Path) -> None:
    path = write(tmp_path / "x.npz", {**parts, "more.npy": header((10**12,)), "notes": b"?"})
    assert Record.load(path).physical_equal(walk_record(2))


def test_a_file_of_today_loads(parts: PARTS, tmp_path: Path) -> None:
    """Files of the first format had their facts as they came: no omega, tables of any kind."""
    old = {"format": 1, "robot": "talos", "mass": 90.0, "gravity": 9.81, "control_hz": 500}
    old |= {"sole": [0.1, 0.06], "pushes": [{"t": 1.0, "body": None}], "fall_time": None}
    text = json.dumps({**old, "of_the_past": 1})
    loaded = Record.load(write(tmp_path / "x.npz", {**parts, "settings.npy": settings(text)}))
    assert (loaded.run.mass, loaded.run.sole) == (90.0, (0.1, 0.06))
    assert np.isnan(loaded.run.omega)


def test_cut_and_turned_bytes_never_break_out(parts: PARTS, tmp_path: Path) -> None:
    """Whatever single byte or tail of a file is wrong, it is a record or one sentence."""
    whole = write(tmp_path / "x.npz", parts).read_bytes()
    random = np.random.default_rng(3)
    path = tmp_path / "y.npz"
    refused = 0
    for case in range(300):
        content = bytearray(whole)
        if case % 3:
            # Half of the damage goes into the directory at the end, which names sizes.
            low = 0 if case % 2 else len(content) - 3000
            for at in random.integers(low, len(content), size=1 + case % 4):
                content[at] = random.integers(256)
        else:
            del content[random.integers(len(content)) :]
        path.write_bytes(content)
        try:
            Record.load(path)
        except InvalidInput:
            refused += 1
    assert refused > 200


def test_a_bomb_takes_no_memory(parts: PARTS, tmp_path: Path) -> None:
    n = 60_000_000
    path = tmp_path / "bomb.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in parts.items():
            if name != "time.npy":
                archive.writestr(name, content)
        with archive.open("time.npy", "w", force_zip64=True) as member:
            member.write(header((n,)))
            for _ in range(60):
                member.write(bytes(8 * n // 60))
    assert path.stat().st_size < 2_000_000
    refused_within_10_mb(path, "would unpack to")


def test_a_shape_that_lies_takes_no_memory(parts: PARTS, tmp_path: Path) -> None:
    lie = {"com.npy": header((40_000_000, 3)) + bytes(24)}
    path = write(tmp_path / "x.npz", {**parts, **lie})
    refused_within_10_mb(path, "states the shape")


def test_a_size_that_the_directory_lies_about_is_not_believed(parts: PARTS, tmp_path: Path) -> None:
    """The directory says little, the stream holds much: no more is read than was said."""
    path = write(tmp_path / "x.npz", {**parts, "time.npy": npy(np.zeros(5_000_000))})
    content = path.read_bytes()
    large, small = (int(size).to_bytes(4, "little") for size in (40_000_128, 128 + 8))
    path.write_bytes(content.replace(large, small))
    with pytest.raises(InvalidInput, match="is not a record"):
        Record.load(path)


@pytest.mark.parametrize("path", [None, 3.5, ["x"], "a\0b"])
def test_what_is_no_path_gets_one_sentence(path: Any) -> None:
    record = walk_record(2)
    for use in (Record.load, record.save, record.summary().write, partial(plot, record)):
        with pytest.raises(InvalidInput, match=r"^a file's name must be a path, got") as caught:
            use(path)
        assert caught.value.argument == "path"


def test_a_name_too_long_is_of_no_file(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="does not exist"):
        Record.load(tmp_path / ("x" * 5000))


def test_folders_and_pipes_are_no_records(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InvalidInput, match="holds no record's blocks"):
        Record.load(tmp_path)
    for path in (tmp_path / "pipe", "/dev/zero"):
        with pytest.raises(InvalidInput, match="it is not a file"):
            Record.load(path)


def test_a_large_record_of_constants_is_still_read(
    parts: PARTS, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only files past `SMALL` are asked how much they unpack to."""
    path = write(tmp_path / "x.npz", parts)
    monkeypatch.setattr(record_file, "EXPANSION", 0.0)
    Record.load(path)
    monkeypatch.setattr(record_file, "SMALL", 0)
    with pytest.raises(InvalidInput, match="would unpack to"):
        Record.load(path)
