"""A record as an MCAP file of ROS 2 messages, for Foxglove, PlotJuggler and rosbag2."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from preview_walk.arguments import instance_of
from preview_walk.extras import require
from preview_walk.files import whole_file
from preview_walk.geometry.quaternions import quaternions_of
from preview_walk.record.record import Record
from preview_walk.record.ros_messages import definition_of

WORLD, BASE = "world", "base_link"
"""Frames of what is in world axes, and of the robot's base."""

POINTS = ("com", "com_ref", "dcm", "dcm_ref", "zmp", "zmp_ref")
POSES = ("left_foot", "right_foot", "left_foot_ref", "right_foot_ref")
WRENCHES = ("left_force", "right_force")

_KINDS = {
    "/tf": "tf2_msgs/TFMessage",
    "/joint_states": "sensor_msgs/JointState",
    **{f"/{name}": "geometry_msgs/PointStamped" for name in POINTS},
    **{f"/{name}": "geometry_msgs/PoseStamped" for name in POSES},
    **{f"/{name}": "geometry_msgs/WrenchStamped" for name in WRENCHES},
}
"""The message of each topic."""


def write_mcap(record: Record, path: str | os.PathLike[str]) -> Path:
    """Write a record as MCAP, one message a topic and tick; return the file's path.

    `/tf` (world to base_link), `/joint_states` (rad, rad/s, N·m), `/com`, `/dcm`, `/zmp` and their
    `_ref` as points, `/left_foot`, `/right_foot` and their `_ref` as poses, `/left_force` and
    `/right_force` as wrenches about the soles' centres in world axes. Times are simulated. What is
    nan at a tick, as the ZMP in flight, has no message there.

    Args:
        record: of a run.
        path: of the file, by custom `.mcap`.

    Raises:
        InvalidInput: no record, or the package mcap-ros2-support is not installed.
        OutputError: the file cannot be written.
    """
    instance_of(record, Record, "record")
    require("an MCAP file", "export", "mcap_ros2")
    from mcap_ros2.writer import Writer

    with whole_file(path) as part, part.open("wb") as stream:
        writer: Any = Writer(stream)
        kinds = {
            kind: writer.register_msgdef(kind.replace("/", "/msg/"), definition_of(kind))
            for kind in dict.fromkeys(_KINDS.values())
        }
        for stamp, topic, message in _messages(record):
            writer.write_message(topic, kinds[_KINDS[topic]], message, stamp, stamp)
        writer.finish()
    return Path(path)


def _messages(record: Record) -> Iterator[tuple[int, str, dict[str, Any]]]:
    """Yield the time (ns), the topic and the message of everything."""
    joints = list(record.run.joint_names)
    turns = {name: quaternions_of(getattr(record, name)[:, :3, :3]) for name in POSES}
    for k, time in enumerate(record.time.tolist()):
        stamp = round(time * 1e9)
        head = _header(stamp)
        q, v = record.q[k], record.v[k]
        place = {"translation": _xyz(q[:3]), "rotation": _xyzw(q[3:7])}
        base = {"header": head, "child_frame_id": BASE, "transform": place}
        yield stamp, "/tf", {"transforms": [base]}
        state = {"name": joints, "position": q[7:].tolist(), "velocity": v[6:].tolist()}
        effort = record.tau[k].tolist()
        yield stamp, "/joint_states", {"header": head, **state, "effort": effort}
        for name in POINTS:
            point = getattr(record, name)[k]
            if np.isfinite(point).all():
                yield stamp, f"/{name}", {"header": head, "point": _xyz(point)}
        for name in POSES:
            pose, turn = getattr(record, name)[k], turns[name][k]
            if np.isfinite(turn).all():
                at = {"position": _xyz(pose[:3, 3]), "orientation": _xyzw(turn)}
                yield stamp, f"/{name}", {"header": head, "pose": at}
        for name in WRENCHES:
            wrench = getattr(record, name)[k]
            if np.isfinite(wrench).all():
                both = {"force": _xyz(wrench[:3]), "torque": _xyz(wrench[3:])}
                yield stamp, f"/{name}", {"header": head, "wrench": both}


def _header(stamp: int) -> Mapping[str, Any]:
    seconds, rest = divmod(stamp, 10**9)
    return {"stamp": {"sec": seconds, "nanosec": rest}, "frame_id": WORLD}


def _xyz(values: Any) -> dict[str, float]:
    """Return a point or vector; one of the plane is at height 0."""
    x, y, z = (*np.asarray(values).tolist(), 0.0)[:3]
    return {"x": x, "y": y, "z": z}


def _xyzw(values: Any) -> dict[str, float]:
    return dict(zip("xyzw", np.asarray(values).tolist(), strict=True))
