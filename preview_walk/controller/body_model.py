"""A robot as the walking pattern sees it: its legs, its soles, how it swings them."""

from __future__ import annotations

import pinocchio as pin

from preview_walk.controller.momentum_model import momentum_model
from preview_walk.pattern.com_height import LegGeometry
from preview_walk.pattern.walker_model import WalkerModel
from preview_walk.robots.robot import Robot

SWING_HEIGHT = 0.06
"""Height of the swing foot's apex over the leg's length, where none is given."""

BLIND_SWING_HEIGHT = 0.12
"""The same where the ground is not known."""


def leg_geometry(robot: Robot) -> LegGeometry:
    """Return what the CoM's height over long steps depends on, from the walking posture."""
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    hip, sole = data.oMi[robot.legs["left"].hip], data.oMf[robot.soles["left"].frame]
    height = hip.translation[2] - sole.translation[2]
    return LegGeometry(robot.leg_length, float(height), robot.com_height)


def walker_model(robot: Robot, swing_height: float) -> WalkerModel:
    """Return a robot as the walking pattern sees it.

    Args:
        robot: the robot.
        swing_height: of the apex of a swing, m.
    """
    return WalkerModel(leg_geometry(robot), robot.sole, momentum_model(robot), swing_height)
