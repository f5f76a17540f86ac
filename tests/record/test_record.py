"""The record: what goes in comes out, bit for bit, whole or not at all."""

from __future__ import annotations

import copy
import dataclasses
import errno
import json
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic_walk import walk_record

from preview_walk import files
from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError
from preview_walk.record.fields import FIELDS, field_table
from preview_walk.record.record import Record
from preview_walk.record.recorder import Recorder, package_versions
from preview_walk.record.run_facts import RunFacts

SIZES = {"nq": 10, "nv": 9, "nu": 3}
ASKED_FOR = """
    time q v tau com com_ref dcm dcm_ref zmp zmp_ref left_foot right_foot left_foot_ref
    right_foot_ref left_force right_force phase phase_ref tick_time qp_time qp_iterations qp_status
"""


@pytest.fixture(scope="module")
def record() -> Record:
    return walk_record(4)


def test_fields_have_all_that_was_asked_for_with_units_and_words() -> None:
    assert set(ASKED_FOR.split()) <= set(FIELDS)
    assert all(info.unit and info.doc for info in FIELDS.values())
    assert len(field_table().splitlines()) == len(FIELDS)
    timing = {name for name, info in FIELDS.items() if info.timing}
    assert timing == {"tick_time", "terms_time", "assembly_time", "qp_time"}


def test_readme_documents_every_field() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    for name, info in FIELDS.items():
        shape = ", ".join(["N", *map(str, info.shape)]) + ("" if info.shape else ",")
        assert f"| `{name}` | ({shape}) | {info.unit} | {info.doc} |" in readme


def test_save_and_load_give_the_same_bits(record: Record, tmp_path: Path) -> None:
    path = record.save(tmp_path / "walk.npz")
    loaded = Record.load(path)
    assert loaded.differences(record) == ()
    for name, array in record.arrays().items():
        assert getattr(loaded, name).tobytes() == array.tobytes()
        assert getattr(loaded, name).dtype == array.dtype
    assert loaded.run == record.run
    assert [p.name for p in tmp_path.iterdir()] == ["walk.npz"]


def test_the_file_loads_without_pickle_and_is_the_same_each_time(
    record: Record, tmp_path: Path
) -> None:
    first, second = record.save(tmp_path / "a.npz"), record.save(tmp_path / "b.npz")
    assert first.read_bytes() == second.read_bytes()
    with np.load(first, allow_pickle=False) as archive:
        assert set(FIELDS) < set(archive.files)
        assert archive["com"].shape == (len(record), 3)
        assert '"robot": "synthetic"' in str(archive["settings"])


def test_an_empty_record_can_be_saved_and_summarised(tmp_path: Path) -> None:
    empty = Recorder(RunFacts(control_hz=500), SIZES).finish(interrupted=True)
    loaded = Record.load(empty.save(tmp_path / "empty.npz"))
    assert len(loaded) == 0
    assert len(loaded.plans) == 0
    assert loaded.summary().duration == 0.0


def test_recorder_grows_copies_and_marks_what_is_missing() -> None:
    recorder = Recorder(RunFacts(control_hz=500), SIZES, room=2)
    com = np.zeros(3)
    for i in range(7):
        com[:] = i
        recorder.write(time=0.002 * i, com=com, phase=i % 3)
    made = recorder.finish()
    np.testing.assert_array_equal(made.com[:, 1], np.arange(7))
    np.testing.assert_array_equal(made.phase, np.arange(7) % 3)
    assert np.isnan(made.zmp).all()
    assert (made.qp_status == -1).all()


def test_a_row_that_breaks_half_way_is_not_counted() -> None:
    recorder = Recorder(RunFacts(control_hz=500), SIZES)
    recorder.write(time=0.0)
    with pytest.raises(ValueError, match="could not broadcast"):
        recorder.write(time=0.002, com=np.zeros(4))
    assert len(recorder) == 1
    assert len(recorder.finish()) == 1


def test_arrays_and_facts_cannot_be_changed(record: Record) -> None:
    with pytest.raises(ValueError, match="read-only"):
        record.com[0, 0] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        record.run.robot = "other"  # type: ignore[misc]


def test_a_record_pickles_and_copies_and_stays_read_only(record: Record) -> None:
    for twin in (pickle.loads(pickle.dumps(record)), copy.deepcopy(record), copy.copy(record)):
        assert twin.differences(record) == ()
        assert twin.run == record.run
        for name, array in {**twin.arrays(), **twin.plans.arrays()}.items():
            assert not array.flags.writeable, name


def test_loaded_arrays_are_read_only(record: Record, tmp_path: Path) -> None:
    loaded = Record.load(record.save(tmp_path / "x.npz"))
    for name, array in {**loaded.arrays(), **loaded.plans.arrays()}.items():
        assert not array.flags.writeable, name


def test_the_callers_arrays_are_not_kept(record: Record) -> None:
    com = record.com.copy()
    view = com[:]
    view.setflags(write=False)  # the caller can still write through `com`
    for given in (com, view):
        made = dataclasses.replace(record, com=given)
        com[0] = 9.0
        np.testing.assert_array_equal(made.com, record.com)
        com[0] = record.com[0]
        assert com.flags.writeable
    # What nobody can write to is not copied.
    assert made.zmp is record.zmp


def test_a_record_of_a_run_that_goes_on_does_not_change() -> None:
    recorder = Recorder(RunFacts(control_hz=500), SIZES, room=4)
    recorder.write(time=0.0, com=np.zeros(3))
    first = recorder.finish()
    recorder._ticks._arrays["com"][0] = 1.0
    assert (first.com == 0.0).all()


@pytest.mark.parametrize("junk", [None, "text", 1.0, [[1, 2], [3]], np.zeros(3, dtype=complex)])
def test_what_is_no_array_is_refused(record: Record, junk: Any) -> None:
    for name in ("time", "com", "phase"):
        with pytest.raises(InvalidInput) as caught:
            dataclasses.replace(record, **{name: junk})
        assert caught.value.argument


def test_wrong_shape_is_refused_in_one_sentence(record: Record) -> None:
    n = len(record)
    sentence = (
        f"record field 'com' must have the shape (N, 3) with N = {n} ticks, got ({n - 1}, 3)."
    )
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        dataclasses.replace(record, com=record.com[1:])
    sentence = f"record field 'tau' must have the shape (N, nu) with N = {n} ticks, got ({n}, 0)."
    broken = np.zeros((n, 0))
    assert dataclasses.replace(record, tau=broken).tau.shape == (n, 0)
    with pytest.raises(InvalidInput, match="record field 'tau' must have the shape"):
        dataclasses.replace(record, tau=np.zeros(n))


def test_physical_equal_sees_one_bit_but_no_stopwatch(record: Record) -> None:
    slow = dataclasses.replace(record, tick_time=2 * record.tick_time, qp_time=record.qp_time + 1)
    assert record.physical_equal(slow.with_run(wall_time=99.0, command="again"))
    com = record.com.copy()
    com[3, 1] = np.nextafter(com[3, 1], 9)
    assert record.differences(dataclasses.replace(record, com=com)) == ("com",)
    assert record.differences(record.with_run(seed=1)) == ("run.seed",)
    assert "step_pose" in record.differences(walk_record(5))


def test_two_makings_are_equal(record: Record) -> None:
    assert record.physical_equal(walk_record(4))


@pytest.mark.parametrize("content", [b"", b"not a zip", None])
def test_a_file_that_is_no_record_gets_one_sentence(content: bytes | None, tmp_path: Path) -> None:
    path = tmp_path / "x.npz"
    if content is None:
        np.savez(path, com=np.zeros(3))
    else:
        path.write_bytes(content)
    with pytest.raises(InvalidInput, match=r"x.npz is not a record written by preview_walk \("):
        Record.load(path)


def test_a_missing_or_newer_file_gets_one_sentence(record: Record, tmp_path: Path) -> None:
    path = tmp_path / "x.npz"
    with pytest.raises(InvalidInput, match=re.escape(f"record file {path} does not exist.")):
        Record.load(path)
    text = np.array(json.dumps({"format": 99, **record.run.as_dict()}))
    np.savez(path, settings=text, **record.arrays(), **record.plans.arrays())
    sentence = f"{path} was written by a newer preview_walk; this one reads records up to format 1."
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        Record.load(path)


def test_a_full_disk_leaves_the_old_file_and_no_rest(
    record: Record, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "walk.npz"
    path.write_bytes(b"old")

    def full(descriptor: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(files.os, "fsync", full)
    with pytest.raises(
        OutputError, match=re.escape(f"cannot write {path}: No space left on device.")
    ):
        record.save(path)
    assert [p.name for p in tmp_path.iterdir()] == ["walk.npz"]
    assert path.read_bytes() == b"old"


def test_ctrl_c_while_saving_leaves_the_old_file_and_no_rest(
    record: Record, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "walk.npz"
    path.write_bytes(b"old")

    def interrupted(*_: Any, **__: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(np.lib.format, "write_array", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record.save(path)
    assert [p.name for p in tmp_path.iterdir()] == ["walk.npz"]
    assert path.read_bytes() == b"old"


def test_a_missing_folder_gets_one_sentence(record: Record, tmp_path: Path) -> None:
    path = tmp_path / "none" / "walk.npz"
    with pytest.raises(
        OutputError, match=re.escape(f"cannot write {path}: No such file or directory.")
    ):
        record.save(path)


def test_package_versions_name_the_engines() -> None:
    assert {"python", "mujoco", "pin", "osqp", "numpy"} <= set(package_versions())
