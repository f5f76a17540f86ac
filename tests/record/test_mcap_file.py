"""An MCAP file read back by its own library holds what the record does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mcap_ros2.reader import read_ros2_messages
from synthetic_walk import walk_record

import preview_walk as pw

RECORD = walk_record().with_run(joint_names=["hip", "knee", "ankle"])


def test_every_topic_holds_what_the_record_does(tmp_path: Path) -> None:
    path = pw.write_mcap(RECORD, tmp_path / "walk.mcap")
    found: dict[str, list[object]] = {}
    for message in read_ros2_messages(str(path)):
        found.setdefault(message.channel.topic, []).append(message.ros_msg)
    states = found["/joint_states"]
    assert [s.name for s in states[:1]] == [["hip", "knee", "ankle"]]
    assert np.array([s.position for s in states]) == pytest.approx(RECORD.q[:, 7:], abs=0)
    assert np.array([s.effort for s in states]) == pytest.approx(RECORD.tau, abs=0)
    com = np.array([[m.point.x, m.point.y, m.point.z] for m in found["/com"]])
    assert np.array_equal(com, RECORD.com)
    force = [m.wrench.force.z for m in found["/left_force"]]
    assert force == RECORD.left_force[:, 2].tolist()
    base = [m.transforms[0].transform.translation.z for m in found["/tf"]]
    assert base == RECORD.q[:, 2].tolist()
    stamps = [m.header.stamp.sec + 1e-9 * m.header.stamp.nanosec for m in states]
    assert stamps == pytest.approx(RECORD.time, abs=1e-9)
    assert len(found["/zmp"]) == np.isfinite(RECORD.zmp).all(axis=1).sum()


def test_what_is_no_record_is_told(tmp_path: Path) -> None:
    with pytest.raises(pw.InvalidInput, match="record must be a Record"):
        pw.write_mcap(None, tmp_path / "x.mcap")
