"""The world: state and forces in one convention, motors on their joints, no hidden hand."""

from __future__ import annotations

import re

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import models_folder
from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.rates import steps_per_tick
from preview_walk.simulation.world import World
from preview_walk.types import FEET, Array

HZ = 1000


def world_of(robot: Robot, lifted: float = 0.0, friction: float = 0.8) -> World:
    """Return a world with the robot in its posture, above the floor by `lifted` (m)."""
    world = World(robot, physics_hz=HZ, friction=friction)
    q = np.array(robot.posture)
    q[2] += lifted
    world.place(q, 0.0)
    world.sense()
    return world


def com_of(robot: Robot, world: World) -> tuple[Array, Array]:
    data = robot.pin.createData()
    pin.centerOfMass(robot.pin, data, world.q, world.v)
    return np.array(data.com[0]), np.array(data.vcom[0])


def test_places_the_robot_as_told(talos: Robot) -> None:
    world = World(talos, physics_hz=HZ)
    q = pin.randomConfiguration(talos.pin, -np.ones(talos.pin.nq), np.ones(talos.pin.nq))
    world.place(q, 0.0)
    world.sense()
    assert world.q == pytest.approx(q, abs=1e-12)
    assert (world.v == 0.0).all()
    # MuJoCo's centre of mass is Pinocchio's.
    assert world.data.subtree_com[0] == pytest.approx(com_of(talos, world)[0], abs=1e-9)


def test_falls_freely_in_the_air(talos: Robot) -> None:
    """No contact: no force measured, and the CoM falls as everything does."""
    world = world_of(talos, lifted=1.0)
    start, _ = com_of(talos, world)
    world.step(np.zeros(talos.pin.nv - 6), 100)
    world.sense()
    com, velocity = com_of(talos, world)
    assert velocity == pytest.approx((0.0, 0.0, -0.981), abs=2e-3)
    assert com - start == pytest.approx((0.0, 0.0, -0.5 * 9.81 * 0.1**2), abs=1e-3)
    assert all((world.wrench[foot] == 0.0).all() for foot in FEET)
    assert (world.push == 0.0).all()


def test_each_torque_reaches_its_own_joint(talos: Robot) -> None:
    """In the order of v[6:], with the motors' order in the MuJoCo model unknown."""
    world = world_of(talos, lifted=1.0)
    torques = np.linspace(-1.0, 1.0, talos.pin.nv - 6) * np.minimum(talos.effort, 1.0)
    world.step(torques, 1)
    assert world.data.qfrc_actuator[:6] == pytest.approx(np.zeros(6), abs=1e-12)
    assert world.data.qfrc_actuator[6:] == pytest.approx(torques, abs=1e-12)
    for name, torque in zip(talos.joint_names, torques, strict=True):
        dof = talos.mj.joint(name).dofadr[0]
        assert world.data.qfrc_actuator[dof] == pytest.approx(torque, abs=1e-12)


def test_joints_without_a_motor_do_not_shift_the_torques_of_others() -> None:
    spec = mujoco.MjSpec.from_file(str(models_folder() / "humanoid-walker.xml"))
    for motor in list(spec.actuators):
        if motor.target == "left_elbow":
            spec.delete(motor)
    robot = load_robot(spec)
    world = World(robot)
    torques = np.arange(1.0, 1.0 + len(robot.joint_names))
    world.place(robot.posture, 0.0)
    world.step(torques, 1)
    driven = {
        world.model.joint(int(joint)).name: float(ctrl)
        for joint, ctrl in zip(world.model.actuator_trnid[:, 0], world.data.ctrl, strict=True)
    }
    named = dict(zip(robot.joint_names, torques.tolist(), strict=True))
    del named["left_elbow"]
    assert driven == named


def test_pushes_come_by_the_clock_of_a_walk_that_begins_late(talos: Robot) -> None:
    world = World(talos, pushes=[Push(5.1, 0.1, (3.0, 0.0, 0.0))])
    world.place(talos.posture, 5.0)
    felt = []
    for _ in range(6):
        world.step(np.zeros(talos.pin.nv - 6), 50)
        felt.append(float(world.push[0]))
    assert felt == [0.0, 0.0, 3.0, 3.0, 0.0, 0.0]


def test_joints_accelerate_as_the_dynamics_say(talos: Robot) -> None:
    """Pinocchio foretells MuJoCo's next velocity, (M + h D)^-1 (tau - bias) h from rest."""
    world = world_of(talos, lifted=1.0)
    world.model.dof_frictionloss[:] = 0.0  # dry friction of the joints: not in these equations
    random = np.random.default_rng(0)
    torques = random.uniform(-1.0, 1.0, talos.pin.nv - 6) * np.minimum(talos.effort, 5.0)
    data = talos.pin.createData()
    mass = np.triu(pin.crba(talos.pin, data, world.q))
    mass += np.triu(mass, 1).T
    damping = np.concatenate([np.zeros(6), talos.damping])
    bias = pin.nonLinearEffects(talos.pin, data, world.q, world.v)
    effort = np.concatenate([np.zeros(6), torques]) - bias
    expected = np.linalg.solve(mass + np.diag(damping) / HZ, effort) / HZ
    world.step(torques, 1)
    world.sense()
    assert np.abs(expected).max() > 0.1
    assert world.v == pytest.approx(expected, abs=1e-4)


def test_motors_give_no_more_than_they_can(talos: Robot) -> None:
    world = world_of(talos, lifted=1.0)
    world.step(3.0 * np.where(talos.effort > 0.0, talos.effort, 1.0), 1)
    given = world.data.qfrc_actuator[6:]
    assert (np.abs(given) <= talos.effort + 1e-9).all()


def test_the_floor_has_the_friction_asked_for(talos: Robot) -> None:
    world = world_of(talos, friction=0.37)
    assert (world.model.geom_friction[:, 0] == 0.37).all()
    assert (talos.mj.geom_friction[:, 0] != 0.37).all()  # the robot's own model stays


def test_two_worlds_of_one_robot_share_nothing(talos: Robot) -> None:
    one, other = world_of(talos, 1.0), world_of(talos, 1.0)
    before = other.q.copy()
    one.step(np.zeros(talos.pin.nv - 6), 50)
    one.sense()
    other.sense()
    assert (other.q == before).all()
    assert (one.q != before).any()


@pytest.mark.parametrize(("physics", "control", "steps"), [(1000, 500, 2), (500, 500, 1)])
def test_steps_per_tick(physics: int, control: int, steps: int) -> None:
    assert steps_per_tick(physics, control) == steps


@pytest.mark.parametrize(
    ("physics", "control"), [(1000, 300), (500, 1000), (0, 500), (1000, 0), (-1000, -500)]
)
def test_rates_that_cannot_be_are_refused(physics: int, control: int) -> None:
    sentence = f"physics_hz must be a positive multiple of control_hz, got {physics} and {control}."
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        steps_per_tick(physics, control)
