"""Feet of every make: the sole found under them, and the stance on it."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from preview_walk.robots.load import load_robot
from preview_walk.types import FEET


def test_feet_made_of_meshes(spec, original):
    half = np.array((0.1, 0.0425, 0.0125))
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
    spec.add_mesh(name="foot", uservert=corners.reshape(-1).astype(np.float32))
    for foot in FEET:
        geom = spec.geom(f"{foot}_foot")
        geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, "foot"
    robot = load_robot(spec)
    for foot in FEET:
        assert robot.soles[foot].half_length == pytest.approx(0.1, abs=1e-6)
        assert robot.soles[foot].half_width == pytest.approx(0.0425, abs=1e-6)
    assert robot.com_height == pytest.approx(original.com_height, abs=1e-6)


@pytest.mark.parametrize("shape", ["box", "capsules"])
def test_feet_that_are_tilted_in_the_zero_pose(spec, original, shape):
    """Ten degrees nose down: the sole is the foot's flat, and the ankle makes up for the tilt."""
    down = pin.rpy.rpyToMatrix(0.0, np.radians(10.0), 0.0)
    turn = pin.Quaternion(down).coeffs()
    for foot in ("left_foot", "right_foot"):
        geom = spec.geom(foot)
        geom.pos, geom.quat = down @ geom.pos, (turn[3], *turn[:3])
        if shape == "capsules":
            spec.delete(geom)
            for side in (-0.03, 0.03):
                ends = np.array(((-0.07, side, -0.0625), (0.13, side, -0.0625))) @ down.T
                spec.body(foot).add_geom(
                    type=mujoco.mjtGeom.mjGEOM_CAPSULE, fromto=ends.ravel(), size=(0.0125, 0, 0)
                )
    robot = load_robot(spec)
    sole = robot.soles["left"]
    width = 0.085 if shape == "box" else 0.06
    assert (2 * sole.half_length, 2 * sole.half_width) == pytest.approx((0.2, width), abs=1e-6)
    assert robot.com_height == pytest.approx(original.com_height, abs=2e-3)
    ankle = robot.joint_names.index("left_ankle_pitch")
    tilt = robot.posture[7 + ankle] - original.posture[7 + ankle]
    assert tilt == pytest.approx(-np.radians(10.0), abs=0.01)


def test_legs_that_straddle_in_the_zero_pose(spec, original):
    for foot, angle in (("left", 0.4), ("right", -0.4)):
        spec.body(f"{foot}_hip").quat = (np.cos(angle / 2), np.sin(angle / 2), 0.0, 0.0)
        spec.joint(f"{foot}_hip_roll").range = (-1.0, 1.0)
        spec.joint(f"{foot}_ankle_roll").range = (-1.0, 1.0)
    spec.delete(spec.keys[0])
    robot = load_robot(spec)
    assert robot.step_width == pytest.approx(original.step_width, abs=1e-6)
    assert robot.com_height == pytest.approx(original.com_height, abs=2e-3)


def test_feet_made_of_four_spheres(spec):
    for foot in FEET:
        spec.delete(spec.geom(f"{foot}_foot"))
        for x in (-0.06, 0.12):
            for y in (-0.03, 0.03):
                spec.body(f"{foot}_foot").add_geom(
                    type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.005, 0, 0), pos=(x, y, -0.07)
                )
    robot = load_robot(spec)
    assert robot.soles["left"].half_length == pytest.approx(0.09)
    assert robot.soles["left"].half_width == pytest.approx(0.03)


def test_toes_lie_beyond_the_foot(spec, original):
    for key in list(spec.keys):
        spec.delete(key)
    for foot in FEET:
        toe = spec.body(f"{foot}_foot").add_body(name=f"{foot}_toe", pos=(0.13, 0.0, -0.06))
        toe.add_joint(name=f"{foot}_toe", axis=(0, 1, 0), range=(-1, 1))
        toe.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.02, 0.04, 0.01), mass=0.05)
    robot = load_robot(spec)
    assert robot.blueprint.soles["left"].body == "left_foot"
    assert robot.leg_length == pytest.approx(original.leg_length)
