"""The same humanoid written in other ways is the same robot."""

from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from robots.same_walk import same_walk

from preview_walk.robots.load import load_robot, visual_model
from preview_walk.robots.reading.description import models_folder
from preview_walk.types import FEET

XML = models_folder() / "humanoid-walker.xml"
ROBOT = cache(load_robot)


def test_file_spec_and_model_in_hand(spec, original):
    for robot in (load_robot(XML), load_robot(str(XML)), load_robot(spec)):
        same_walk(robot, original)
    same_walk(load_robot(spec.compile()), original)


def test_the_spec_in_hand_is_left_alone(spec):
    before = spec.to_xml()
    load_robot(spec)
    assert spec.to_xml() == before


def test_a_robot_that_faces_backward(spec, original):
    spec.body("pelvis").quat = (0.0, 0.0, 0.0, 1.0)
    same_walk(load_robot(spec), original)


def test_a_robot_turned_and_moved_in_the_world(spec, original):
    turned = pin.Quaternion(pin.rpy.rpyToMatrix(0.0, 0.0, 2.1)).coeffs()
    spec.body("pelvis").quat = (turned[3], *turned[:3])
    spec.body("pelvis").pos = (4.0, -3.0, 11.0)
    same_walk(load_robot(spec), original)


def test_a_base_whose_own_axes_are_odd(original):
    """Bodies drawn with y up, as in motion capture: the soles still face x and z."""
    text = XML.read_text().replace(
        '<body name="pelvis" pos="0 0 0.93">',
        '<body name="world_frame"><freejoint/><inertial pos="0 0 0" mass="1e-9"'
        ' diaginertia="1e-9 1e-9 1e-9"/><body name="pelvis" quat="1 1 0 0" pos="0 0 0.93">',
    )
    text = text.replace('<freejoint name="root"/>', "")
    text = text.replace("</body>\n  </worldbody>", "</body></body>\n  </worldbody>")
    text = text[: text.index("<keyframe>")] + "</mujoco>"
    robot = load_robot(mujoco.MjSpec.from_string(text))
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    for foot in FEET:
        np.testing.assert_allclose(data.oMf[robot.soles[foot].frame].rotation, np.eye(3), atol=1e-9)
    assert robot.leg_length == pytest.approx(original.leg_length)


def test_no_free_joint(spec, original):
    spec.delete(spec.joint("root"))
    for key in list(spec.keys):
        spec.delete(key)
    robot = load_robot(spec)
    assert robot.mj.nv == original.mj.nv
    assert robot.leg_length == pytest.approx(original.leg_length)


def test_free_joint_on_a_mount_around_the_robot(original):
    text = XML.read_text().replace(
        '<body name="pelvis" pos="0 0 0.93">\n      <freejoint name="root"/>',
        '<body name="mount" pos="0 0 1.5"><freejoint/><body name="pelvis" pos="0 0 -0.57">',
    )
    text = text.replace("</body>\n  </worldbody>", "</body></body>\n  </worldbody>")
    robot = load_robot(mujoco.MjSpec.from_string(text))
    same_walk(robot, original)


def test_slides_and_hinges_instead_of_a_free_joint(original):
    """Six joints on three light frames carry the pelvis through its world."""
    frames, closing = "", ""
    for i, axis in enumerate(("1 0 0", "0 1 0", "0 0 1")):
        frames += (
            f'<body name="frame{i}">'
            '<inertial pos="0 0 0" mass="1e-4" diaginertia="1e-6 1e-6 1e-6"/>'
            f'<joint name="slide{i}" type="slide" axis="{axis}" armature="0" damping="0"/>'
        )
        closing += "</body>"
    hinges = "".join(
        f'<joint name="turn{i}" axis="{axis}" armature="0" damping="0"/>'
        for i, axis in enumerate(("1 0 0", "0 1 0", "0 0 1"))
    )
    text = XML.read_text().replace('<body name="pelvis"', frames + '<body name="pelvis"')
    text = text.replace('<freejoint name="root"/>', hinges)
    text = text.replace("</body>\n  </worldbody>", f"</body>{closing}\n  </worldbody>")
    text = text[: text.index("<keyframe>")] + "</mujoco>"
    robot = load_robot(mujoco.MjSpec.from_string(text))
    assert robot.mj.nv == original.mj.nv
    assert robot.mass == pytest.approx(original.mass)
    assert (
        "joints between world and base became a free joint: "
        "slide0, slide1, slide2, turn0, turn1, turn2"
    ) in robot.notes


def test_a_weld_to_the_scene_is_left_out(spec, original):
    spec.add_equality(
        name="crane",
        type=mujoco.mjtEq.mjEQ_WELD,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1="torso",
        name2="world",
    )
    robot = load_robot(spec)
    assert (
        "the scene holds the robot by the weld 'crane' between 'torso' and 'world', which is left "
        "out here"
    ) in robot.notes
    same_walk(robot, original)


def test_other_things_in_the_scene_stay_behind(spec, original):
    box = spec.worldbody.add_body(name="box", pos=(2.0, 0.0, 0.5))
    box.add_freejoint()
    box.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1), mass=1.0)
    for key in list(spec.keys):
        spec.delete(key)
    robot = load_robot(spec)
    assert "not part of the robot, left out: box" in robot.notes
    assert robot.mass == pytest.approx(original.mass)


def test_joints_without_limits(spec, original):
    for joint in spec.joints:
        joint.limited = False
    robot = load_robot(spec)
    assert np.isinf(robot.q_lower).all()
    assert robot.com_height == pytest.approx(original.com_height, abs=1e-3)
    knee = robot.posture[robot.pin.joints[robot.legs["left"].knee].idx_q]
    assert knee > 0.6  # our way, not a bird's


def test_armature_and_damping_come_along(spec):
    for joint in spec.joints:
        joint.armature, joint.damping = 0.3, (2.0, 0.0, 0.0)
    robot = load_robot(spec)
    np.testing.assert_allclose(robot.pin.armature[6:], 0.3)
    np.testing.assert_allclose(robot.damping, 2.0)
    np.testing.assert_allclose(robot.pin.armature[:6], 0.0)


def test_springs_are_left_out(spec):
    spec.joint("waist_yaw").stiffness[0] = 50.0
    robot = load_robot(spec)
    assert "joint springs left out: waist_yaw" in robot.notes
    assert not robot.mj.jnt_stiffness.any()


def test_a_link_without_mass(spec):
    foot = spec.body("left_ankle")
    foot.mass, foot.inertia = 1e-14, (1e-14, 1e-14, 1e-14)
    robot = load_robot(spec)
    assert robot.mj.body("left_ankle").mass[0] < 0.01


def test_keyframes_sensors_and_contacts_do_not_matter(spec, original):
    spec.add_sensor(name="clock", type=mujoco.mjtSensor.mjSENS_CLOCK)
    spec.add_exclude(bodyname1="left_hip", bodyname2="right_hip")
    same_walk(load_robot(spec), original)


def test_a_keyframe_outside_the_limits_is_brought_inside(spec):
    spec.keys[0].qpos[11] = 0.4  # left elbow, which bends from -2.3 to 0
    robot = load_robot(spec)
    elbow = robot.posture[7 + robot.joint_names.index("left_elbow")]
    assert elbow == pytest.approx(-0.05)


def test_a_joint_that_mimics_another_is_locked(spec, original):
    coupling = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_JOINT, name1="right_elbow", name2="left_elbow"
    )
    coupling.data[:5] = (0.0, 1.0, 0.0, 0.0, 0.0)
    coupling.objtype = mujoco.mjtObj.mjOBJ_JOINT
    robot = load_robot(spec)
    assert "locked, because another joint drives them: right_elbow" in robot.notes
    assert "right_elbow" not in robot.joint_names
    assert robot.mass == pytest.approx(original.mass)


def test_names_that_tell_nothing(original):
    """Left and right from the way the knees bend."""
    text = XML.read_text()
    for foot, letter in (("left", "a"), ("right", "b")):
        text = text.replace(f"{foot}_", f"{letter}_")
    robot = load_robot(mujoco.MjSpec.from_string(text))
    same_walk(robot, original)
    assert "no name tells left from right: taken from the way the knees bend" in robot.notes
    assert robot.blueprint.soles["left"].body == "a_foot"


def test_a_torso_as_base_with_the_waist_above_the_legs():
    """As in MuJoCo's own humanoid: the free joint is on the torso, the pelvis hangs below."""
    text = XML.read_text()
    start, end = text.index('      <body name="torso"'), text.index('\n      <body name="left_hip"')
    torso, legs = text[start:end], text[end : text.index("\n    </body>\n  </worldbody>")]
    head = text[: text.index('    <body name="pelvis"')]
    waist = torso[torso.index("        <joint") : torso.index("        <inertial")]
    trunk = torso.replace(waist, "").replace('pos="0 0 0.1"', 'pos="0 0 1.03"', 1)
    trunk = (
        trunk.rstrip()
        .removesuffix("</body>")
        .replace('<body name="torso"', '<body name="torso"', 1)
    )
    trunk = trunk.replace('pos="0 0 1.03">', 'pos="0 0 1.03"><freejoint/>', 1)
    pelvis = (
        '<body name="pelvis" pos="0 0 -0.1">'
        + waist
        + '<inertial pos="0 0 0" mass="9" diaginertia="0.07 0.05 0.07"/>'
    )
    tail = (
        "</body></body></worldbody>" + text[text.index("  <actuator>") : text.index("  <keyframe>")]
    )
    robot = load_robot(mujoco.MjSpec.from_string(head + trunk + pelvis + legs + tail + "</mujoco>"))
    names = [robot.pin.names[joint] for joint in robot.legs["left"].joints]
    assert names[0] == "left_hip_yaw"
    assert len(names) == 6
    assert robot.leg_length == pytest.approx(ROBOT("humanoid-walker").leg_length)


def test_visual_model_has_the_same_state_and_more_to_see(original):
    seen = visual_model(original)
    assert (seen.nq, seen.nv, seen.nu) == (original.mj.nq, original.mj.nv, original.mj.nu)
    assert seen.ngeom > original.mj.ngeom
    np.testing.assert_allclose(seen.body_inertia, original.mj.body_inertia)


def test_a_description_beside_ones_own_model(tmp_path: Path, original):
    (tmp_path / "mine.xml").write_text(XML.read_text())
    (tmp_path / "mine.json").write_text(
        '{"model": "mine.xml", "soles": {'
        '"left": {"body": "left_foot", "size": [0.16, 0.07], "center": [0.03, 0, -0.075]},'
        '"right": {"body": "right_foot", "size": [0.16, 0.07], "center": [0.03, 0, -0.075]}}}'
    )
    robot = load_robot(tmp_path / "mine.json")
    assert robot.soles["left"].half_length == 0.08
    assert robot.com_height == pytest.approx(original.com_height)
