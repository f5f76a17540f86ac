"""Definitions of the ROS 2 messages that a record is exported as, dependencies included.

As in the packages std_msgs, geometry_msgs, sensor_msgs and tf2_msgs, without their comments.
"""

from __future__ import annotations

_RULE = "=" * 80

_PARTS = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation",
    "geometry_msgs/Wrench": "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque",
    "geometry_msgs/Transform": (
        "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"
    ),
    "geometry_msgs/TransformStamped": (
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform"
    ),
    "geometry_msgs/PointStamped": "std_msgs/Header header\ngeometry_msgs/Point point",
    "geometry_msgs/PoseStamped": "std_msgs/Header header\ngeometry_msgs/Pose pose",
    "geometry_msgs/WrenchStamped": "std_msgs/Header header\ngeometry_msgs/Wrench wrench",
    "sensor_msgs/JointState": (
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort"
    ),
    "tf2_msgs/TFMessage": "geometry_msgs/TransformStamped[] transforms",
}


def definition_of(name: str) -> str:
    """Return the definition of a message with all that it is made of, as MCAP holds it.

    Args:
        name: "package/Message".
    """
    needed = [name]
    for part in needed:
        for line in _PARTS[part].splitlines():
            kind = line.split()[0].removesuffix("[]")
            if kind in _PARTS and kind not in needed:
                needed.append(kind)
    rest = "".join(f"\n{_RULE}\nMSG: {part}\n{_PARTS[part]}" for part in needed[1:])
    return _PARTS[name] + rest
