"""Motors as models have them, and the torques that the robot then has."""

import mujoco
import numpy as np
from robots.same_walk import same_walk

from preview_walk.robots.load import load_robot


def test_position_actuators_become_motors(spec, original):
    for motor in spec.actuators:
        limit = motor.ctrlrange[1]
        motor.set_to_position(kp=300.0)
        motor.ctrlrange = (-3.0, 3.0)
        motor.forcelimited, motor.forcerange = True, (-limit, limit)
    robot = load_robot(spec)
    same_walk(robot, original)
    assert "20 position, velocity or other actuators became torque motors" in robot.notes
    gains = {int(t) for t in robot.mj.actuator_biastype}
    assert gains == {int(mujoco.mjtBias.mjBIAS_NONE)}


def test_gears_multiply_the_torque(spec, original):
    for motor in spec.actuators:
        motor.gear[0], motor.ctrlrange = 50.0, motor.ctrlrange / 50.0
    same_walk(load_robot(spec), original)


def test_motors_without_limits_are_given_some(spec, original):
    for motor in spec.actuators:
        motor.ctrllimited = False
    robot = load_robot(spec)
    np.testing.assert_allclose(robot.effort, 3.0 * original.mass)
    assert any(
        note.startswith("no torque limit: 195 N·m (3 N·m per kg) assumed for left_hip_yaw,")
        for note in robot.notes
    )


def test_joint_force_limits_count_too(spec):
    spec.joint("left_knee").actfrclimited = True
    spec.joint("left_knee").actfrcrange = (-70.0, 70.0)
    robot = load_robot(spec)
    assert robot.effort[robot.joint_names.index("left_knee")] == 70.0
