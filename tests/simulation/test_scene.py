"""The user's scene: models that are made otherwise walk all the same, or say why not."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest
from lab_walks import XML, assert_followed, walk

import preview_walk as pw
from preview_walk.errors import RobotError
from preview_walk.lab.walking_controller import WalkingController

CASES = Path(__file__).parents[1] / "robots" / "cases"


@pytest.fixture
def spec() -> mujoco.MjSpec:
    return mujoco.MjSpec.from_file(str(XML))


def servos(spec: mujoco.MjSpec) -> None:
    for motor in spec.actuators:
        limit = tuple(motor.ctrlrange)
        motor.set_to_position(kp=150.0)
        motor.forcerange, motor.forcelimited = limit, 1
        motor.ctrlrange = (-0.5, 0.5)


def gears(spec: mujoco.MjSpec) -> None:
    for motor in spec.actuators:
        motor.gear[0] = -motor.ctrlrange[1]
        motor.ctrlrange = (-1.0, 1.0)


def springs(spec: mujoco.MjSpec) -> None:
    for joint in spec.joints[1:]:
        joint.stiffness = (20.0, 0.0, 0.0)


def higher_floor(spec: mujoco.MjSpec) -> None:
    spec.geom("floor").pos = (0.0, 0.0, 0.3)


def furniture(spec: mujoco.MjSpec) -> None:
    """Put a ball on the floor, before the robot in the state's order."""
    ball = spec.worldbody.add_body(name="ball", pos=(2.0, 0.0, 0.1))
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0.0, 0.0), contype=3, conaffinity=3, mass=1.0)


def contact_pairs(spec: mujoco.MjSpec) -> None:
    """Let the soles touch the floor by explicit pairs alone."""
    for foot in ("left_foot", "right_foot"):
        spec.geom(foot).contype = 0
        spec.add_pair(geomname1=foot, geomname2="floor", friction=(0.6, 0.6, 0.005, 1e-4, 1e-4))


def slow_physics(spec: mujoco.MjSpec) -> None:
    spec.option.timestep = 0.005
    spec.option.cone, spec.option.impratio = mujoco.mjtCone.mjCONE_PYRAMIDAL, 1.0


@pytest.mark.parametrize(
    "change", [servos, gears, springs, higher_floor, furniture, contact_pairs, slow_physics]
)
def test_models_that_are_made_otherwise(
    spec: mujoco.MjSpec, change: Callable[[mujoco.MjSpec], None]
) -> None:
    change(spec)
    assert_followed(walk(spec), 0.3 if change is higher_floor else 0.0)


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (
            lambda spec: spec.delete(spec.geom("floor")),
            "the model has no floor: expected a fixed shape that both feet can touch",
        ),
        (
            lambda spec: setattr(spec.option, "gravity", (0.0, 0.0, -1.62)),
            "gravity must be (0, 0, -9.81) m/s^2, got [0.0, 0.0, -1.62]",
        ),
        (
            lambda spec: spec.delete(spec.joint("root")),
            "the base 'pelvis' must have a free joint to walk with",
        ),
        (
            lambda spec: setattr(spec.actuators[3], "dyntype", mujoco.mjtDyn.mjDYN_INTEGRATOR),
            "the actuator 'left_knee' cannot give a torque at once; "
            "expected a motor, or a position or velocity servo",
        ),
        (
            lambda spec: spec.add_actuator(
                target="left_knee", trntype=mujoco.mjtTrn.mjTRN_JOINT
            ).set_to_motor(),
            "the joint 'left_knee' has two actuators; expected one",
        ),
    ],
)
def test_models_that_cannot_walk(
    spec: mujoco.MjSpec, spoil: Callable[[mujoco.MjSpec], object], sentence: str
) -> None:
    if "free joint" in sentence:
        spec.delete(spec.keys[0])
    spoil(spec)
    model = spec.compile()
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}$"):
        WalkingController(model, mujoco.MjData(model))


def test_a_scene_that_holds_the_robot_is_told() -> None:
    model = mujoco.MjModel.from_xml_path(str(CASES / "weld_active.xml"))
    with pytest.raises(RobotError, match=r"^the scene holds the robot by the weld .* expected it"):
        WalkingController(model, mujoco.MjData(model))


def scene_walk(spec: mujoco.MjSpec) -> pw.Walk:
    """Return a walk that stands in the lab's scene, on a floor 0.3 m high."""
    higher_floor(spec)
    model = spec.compile()
    robot = pw.load_robot(model)
    return pw.Walk.standing(pw.Scene(robot, model, mujoco.MjData(model)), (1.0, -2.0, 0.5))


def test_a_scene_is_walked_by_command_as_the_projects_world_is(spec: mujoco.MjSpec) -> None:
    walk = scene_walk(spec)
    walk.command(0.25, 0.0, 0.1)
    walk.run(until=5.0)
    walk.command(0.0, 0.0, 0.0)
    record = walk.run().record()
    assert not walk.fallen
    assert record.summary().distance > 0.8
    assert np.sqrt(((record.com - record.com_ref) ** 2).mean(axis=0)).max() < 2e-3
    assert record.left_foot[-1, 2, 3] == pytest.approx(0.3, abs=5e-3)


def test_a_copied_scene_goes_on_as_the_original_does(spec: mujoco.MjSpec) -> None:
    walk = scene_walk(spec)
    walk.command(0.25, 0.0, 0.1)
    walk.run(until=2.2)
    twin = copy.deepcopy(walk)
    walk.run(until=3.0)
    twin.run(until=3.0)
    assert twin.record().differences(walk.record()) == ()


def test_settings_that_are_the_plants_own_are_refused_beside_it(spec: mujoco.MjSpec) -> None:
    scene = scene_walk(spec).plant
    for name, value in (("friction", 0.5), ("physics_hz", 500), ("com_height", 0.8)):
        with pytest.raises(pw.InvalidInput, match=f"^{name} must be left out beside a plant"):
            pw.Walk.standing(scene, **{name: value})


def scene_of(spec: mujoco.MjSpec, *pushes: pw.Push, time: float = 0.0) -> pw.Scene:
    """Return a scene whose clock shows `time` (s)."""
    model = spec.compile()
    data = mujoco.MjData(model)
    data.time = time
    return pw.Scene(pw.load_robot(model), model, data, pushes)


def test_the_friction_is_the_larger_of_floor_and_sole_as_mujoco_has_it(
    spec: mujoco.MjSpec,
) -> None:
    for floor, sole, both in ((0.4, 0.7, 0.7), (0.6, 0.5, 0.6)):
        spec.geom("floor").friction[0] = floor
        for foot in ("left_foot", "right_foot"):
            spec.geom(foot).friction[0] = sole
        assert scene_of(spec).friction == pytest.approx(both)


def test_pushes_come_by_the_walks_clock_whatever_the_scenes_shows(spec: mujoco.MjSpec) -> None:
    scene = scene_of(spec, pw.Push(0.1, 0.1, (3.0, 0.0, 0.0)), time=5.0)
    scene.place(scene.robot.posture, 0.0)
    felt = []
    for _ in range(15):
        scene.step(np.zeros(len(scene.robot.effort)), 10)  # 20 ms
        felt.append(float(scene.push[0]))
    assert felt == [0.0] * 5 + [3.0] * 5 + [0.0] * 5


def test_the_ground_pushes_up_whichever_geom_mujoco_names_first(spec: mujoco.MjSpec) -> None:
    """Balls under the left foot come before a box on the floor, after a plane."""
    foot = spec.body("left_foot")
    spec.delete(spec.geom("left_foot"))
    for x in (-0.06, 0.12):
        for y in (-0.03, 0.03):
            size, pos = (0.005, 0.0, 0.0), (x, y, -0.07)
            foot.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=size, pos=pos)
    box = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, contype=3, conaffinity=3)
    box.size, box.pos = (1.0, 1.0, 0.05), (0.0, 0.0, -0.048)
    scene = scene_of(spec)
    scene.place(scene.robot.posture, 0.0)
    scene.sense()
    kinds = {tuple(scene.model.geom_type[geom] for geom in c.geom) for c in scene.data.contact}
    assert (int(mujoco.mjtGeom.mjGEOM_SPHERE), int(mujoco.mjtGeom.mjGEOM_BOX)) in kinds
    for wrench in scene.wrench.values():
        assert wrench[2] > 10.0


def test_a_servo_gives_the_torque_asked_wherever_its_joint_is_and_moves(
    spec: mujoco.MjSpec,
) -> None:
    for motor in spec.actuators:
        limit = tuple(motor.ctrlrange)
        motor.set_to_position(kp=150.0, kv=4.0)
        motor.forcerange, motor.forcelimited = limit, 1
    scene = scene_of(spec)
    scene.place(scene.robot.posture, 0.0)
    dofs = [int(scene.model.joint(name).dofadr[0]) for name in scene.robot.joint_names]
    scene.data.qvel[dofs] = np.linspace(-1.0, 1.0, len(dofs))
    torques = np.linspace(-5.0, 5.0, len(dofs))
    scene.step(torques, 1)
    assert scene.data.qfrc_actuator[dofs] == pytest.approx(torques)
