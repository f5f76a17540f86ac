"""The summary as a value: its file, its table, its line."""

from __future__ import annotations

import copy
import dataclasses
import json
import pickle
from pathlib import Path

import pytest
from synthetic_walk import walk_record

from preview_walk.record.summary import Summary

KEYS = """
    robot fell fall_time fall_reason duration steps distance speed final_position_error
    final_yaw_error com_error_rms zmp_error_rms torque_ratio_max cost_of_transport
    cost_of_transport_positive tick_ms qp_ms
    qp_failures qp_own_share real_time_factor
"""


@pytest.fixture(scope="module")
def summary() -> Summary:
    return walk_record(8).summary()


def test_file_has_exactly_the_keys(summary: Summary, tmp_path: Path) -> None:
    path = summary.write(tmp_path / "summary.json")
    read = json.loads(path.read_text(), parse_constant=pytest.fail)
    assert list(read) == KEYS.split()
    sensed = dict.fromkeys(("velocity_error_rms", "drift", "refused"))
    assert {**read, **sensed} == dataclasses.asdict(summary)
    assert list(read["tick_ms"]) == list(read["qp_ms"]) == ["median", "p99", "max"]


def test_table_is_aligned_and_plain(summary: Summary) -> None:
    lines = str(summary).splitlines()
    assert lines[0].split() == ["robot", "synthetic"]
    assert len({line.index("  ") for line in lines if "  " in line}) >= 1
    column = lines[0].index("synthetic")
    assert all(line[column - 1] == " " and line[column] != " " for line in lines)
    assert "CoM error rms x, y, z   2.00, 1.00, 3.00 mm" in lines
    assert str(summary).isascii()


def test_infinite_figures_are_written_as_null(summary: Summary, tmp_path: Path) -> None:
    odd = dataclasses.replace(
        summary,
        distance=float("inf"),
        fall_time=float("nan"),
        com_error_rms=[float("inf"), 1.0, None],
        tick_ms={"median": float("-inf"), "p99": 1.0, "max": 2.0},
    )
    path = odd.write(tmp_path / "summary.json")
    read = json.loads(path.read_text(), parse_constant=pytest.fail)
    assert read["distance"] is None
    assert read["fall_time"] is None
    assert read["com_error_rms"] == [None, 1.0, None]
    assert read["tick_ms"] == {"median": None, "p99": 1.0, "max": 2.0}


def test_summary_pickles_copies_and_has_one_line(summary: Summary) -> None:
    assert pickle.loads(pickle.dumps(summary)) == copy.deepcopy(summary) == summary
    assert repr(summary) == f"Summary(synthetic, {summary.duration:.3f} s, 8 steps, did not fall)"
