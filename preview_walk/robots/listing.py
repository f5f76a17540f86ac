"""The catalogue as a table."""

from __future__ import annotations

from preview_walk.errors import RobotError
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import catalogue

_HEAD = ("name", "robot", "mass (kg)", "joints", "leg (m)", "CoM (m)", "sole (m)")


def list_robots() -> str:
    """Return the robots of the catalogue, one a line: mass, joints, leg length, CoM, sole size.

    A robot that cannot be loaded is listed with the reason.
    """
    rows: list[tuple[str, ...]] = [_HEAD]
    for name in catalogue():
        try:
            robot = load_robot(name)
        except RobotError as error:
            rows.append((name, str(error), "", "", "", "", ""))
            continue
        sole = robot.soles["left"]
        rows.append(
            (
                name,
                robot.title,
                f"{robot.mass:.1f}",
                f"{len(robot.joint_names)}",
                f"{robot.leg_length:.3f}",
                f"{robot.com_height:.3f}",
                f"{2 * sole.half_length:.3f} x {2 * sole.half_width:.3f}",
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEAD))]
    lines = [
        "  ".join(
            cell.ljust(width) if column < 2 else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    return "\n".join(lines)
