"""A record as a table and as labelled arrays is the record, number for number."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation
from synthetic_walk import walk_plan, walk_record

import preview_walk as pw

RECORD = walk_record()


def test_every_number_of_a_record_is_in_its_table() -> None:
    table = RECORD.to_dataframe()
    assert table.index.name == "time"
    assert np.array_equal(table.index, RECORD.time)
    assert np.array_equal(table[["com_x", "com_y", "com_z"]], RECORD.com)
    assert np.array_equal(table[["zmp_ref_x", "zmp_ref_y"]], RECORD.zmp_ref)
    assert np.array_equal(table["left_force_fz"], RECORD.left_force[:, 2])
    assert np.array_equal(table["phase"], RECORD.phase)
    assert np.array_equal(table["q_base_qw"], RECORD.q[:, 6])
    assert np.array_equal(table.filter(regex="^tau_"), RECORD.tau)
    numbers = sum(array[0].size for array in RECORD.arrays().values()) - 1
    assert table.shape == (len(RECORD), numbers - 4 * (16 - 7))  # four poses as 7 numbers
    assert table.attrs["units"]["com"] == "m"


def test_joints_have_their_names_and_poses_their_quaternions() -> None:
    named = RECORD.with_run(joint_names=["hip", "knee", "ankle"])
    table = named.to_dataframe(["q", "v", "tau", "left_foot"])
    assert np.array_equal(table["q_knee"], RECORD.q[:, 8])
    assert np.array_equal(table["v_base_wz"], RECORD.v[:, 5])
    assert np.array_equal(table["tau_ankle"], RECORD.tau[:, 2])
    turns = Rotation.from_quat(table[[f"left_foot_q{k}" for k in "xyzw"]].to_numpy())
    assert turns.as_matrix() == pytest.approx(RECORD.left_foot[:, :3, :3], abs=1e-12)


def test_what_the_sensors_read_is_in_the_table_too(tmp_path: Path) -> None:
    record = pw.walk_case("talos", (0.0, 0.0, 0.0), 0.1, realism="lab")
    table = record.to_dataframe()
    assert record.sensed is not None
    assert np.array_equal(table["sensed_gyro_y"], record.sensed.gyro[:, 1])
    knee = record.run.joint_names[3]
    assert np.array_equal(table[f"sensed_angles_{knee}"], record.sensed.angles[:, 3])
    data = record.to_xarray()
    assert data["tau"].sel(joint=knee).values.tolist() == record.tau[:, 3].tolist()
    assert data["sensed_left_sole"].sel(wrench="fz").attrs["units"] == "N, N·m"
    read = pd.read_csv(record.to_csv(tmp_path / "joints.csv", ["q"]), index_col="time")
    assert np.array_equal(read, record.q)


def test_arrays_with_names_have_units_and_facts() -> None:
    data = RECORD.to_xarray()
    assert np.array_equal(data["com"].sel(xyz="z"), RECORD.com[:, 2])
    assert data["com"].attrs["units"] == "m"
    assert data.attrs["robot"] == RECORD.run.robot
    assert data["left_foot"].dims == ("time", "row", "column")


def test_a_field_that_is_none_is_told() -> None:
    with pytest.raises(pw.InvalidInput, match=r"fields must be names of arrays .*, got 'speed'"):
        RECORD.to_dataframe(["speed"])


def test_what_is_not_installed_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(pw.InvalidInput, match=r"needs xarray, .* 'preview-walk\[export\]'"):
        RECORD.to_xarray()


def test_notebooks_show_values_as_tables(talos: pw.Robot) -> None:
    plan = walk_plan()
    design = pw.PreviewController().design
    for value, text in (
        (RECORD, "CoM error rms x, y, z"),
        (RECORD.summary(), "did not fall"),
        (talos, "90.3 kg"),
        (plan, "swing_end at"),
        (design, "integral gain"),
    ):
        html = value._repr_html_()
        assert html.startswith("<table>")
        assert text in html
        assert html.count("<tr>") == html.count("</tr>") > 2
