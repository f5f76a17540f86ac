"""Small models of the kinds that public files are full of: each loads right, and walks."""

from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.robots.finding.constraints import holding_constraints
from preview_walk.robots.load import load_robot, visual_model

CASES = Path(__file__).parent / "cases"

robot_of = cache(lambda name: load_robot(CASES / name))

SOLES = {
    "base.mjcf": (0.18, 0.08),
    "contact_pairs.xml": (0.18, 0.08),
    "five_dof_dummy_body.xml": (0.18, 0.08),
    "four_spheres.xml": (0.17, 0.06),
    "missing_visual_mesh.xml": (0.2, 0.085),
    "lfs_pointer_mesh.xml": (0.2, 0.085),
    "self_collision.xml": (0.2, 0.085),
    "seven_dof_tarsus.xml": (0.18, 0.08),
    "tilted_hips_40.xml": (0.18, 0.08),
    "toe.xml": (0.18, 0.08),
    "two_capsules.xml": (0.17, 0.06),
    "weld_active.xml": (0.2, 0.085),
}
"""Length and width (m) of the soles as the files draw them."""

COM_ERROR = {"five_dof_dummy_body.xml": (1e-3, 9e-3, 1e-3)}
"""Bounds (m) of the CoM's rms error: measured are (0.6, 6.0, 0.7) mm for feet that must roll over
their edges to sway, and at most 0.05 mm for all others."""


@pytest.mark.parametrize("name", SOLES)
def test_the_sole_is_the_one_that_is_drawn(name: str) -> None:
    for sole in robot_of(name).soles.values():
        size = (2 * sole.half_length, 2 * sole.half_width)
        assert size == pytest.approx(SOLES[name], abs=1e-6)


@pytest.mark.parametrize("name", SOLES)
def test_it_walks(name: str) -> None:
    robot = robot_of(name)
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, 0.9)
    summary = pw.simulate(robot, planner.generate_footsteps(4)).summary()
    assert not summary.fell
    assert summary.qp_failures == 0
    for error, bound in zip(summary.com_error_rms, COM_ERROR.get(name, 3 * (8e-5,)), strict=True):
        assert error < bound


def test_a_file_called_mjcf_is_the_one_called_xml(tmp_path: Path) -> None:
    (tmp_path / "base.xml").write_bytes((CASES / "base.mjcf").read_bytes())
    there, here = load_robot(tmp_path / "base.xml"), robot_of("base.mjcf")
    assert there.posture.tobytes() == here.posture.tobytes()
    assert there.notes == here.notes == ()


def test_files_that_an_mjcf_includes_are_found_beside_it(tmp_path: Path) -> None:
    text = (CASES / "base.mjcf").read_text()
    start, end = text.index("<actuator>"), text.index("</actuator>") + len("</actuator>")
    (tmp_path / "motors.xml").write_text(f"<mujoco>{text[start:end]}</mujoco>")
    own = text[:start] + '<include file="motors.xml"/>' + text[end:]
    (tmp_path / "my.mjcf").write_text(own)
    assert load_robot(tmp_path / "my.mjcf").effort.tolist() == 12 * [150.0]


def test_a_dummy_body_on_the_world_is_no_part_of_the_robot() -> None:
    robot = robot_of("five_dof_dummy_body.xml")
    assert robot.notes == ("not part of the robot, left out: not_use",)
    assert len(robot.joint_names) == 10


def test_five_joints_leave_the_roll_of_the_sole_free() -> None:
    legs = robot_of("five_dof_dummy_body.xml").legs
    assert [leg.unplaced for leg in legs.values()] == [(3,), (3,)]
    assert [leg.unplaced for leg in robot_of("base.mjcf").legs.values()] == [(), ()]


def test_legs_without_a_hip_yaw_leave_the_yaw_of_the_sole_free() -> None:
    spec = mujoco.MjSpec.from_string((CASES / "base.mjcf").read_text())
    for foot in ("left", "right"):
        spec.delete(spec.joint(f"{foot}_hip_yaw"))
    robot = load_robot(spec)
    assert [leg.unplaced for leg in robot.legs.values()] == [(5,), (5,)]
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, 0.9)
    summary = pw.simulate(robot, planner.generate_footsteps(4)).summary()
    assert not summary.fell
    assert max(summary.com_error_rms) < 5e-3


def test_a_tarsus_is_held_where_it_stands() -> None:
    robot = robot_of("seven_dof_tarsus.xml")
    assert robot.blueprint.soles["left"].body == "left_ankle_roll_link"
    tarsus = robot.joint_names.index("left_tarsus")
    assert robot.posture[7 + tarsus] == pytest.approx(0.0)
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, 0.8)
    record = pw.simulate(robot, planner.generate_footsteps(8))
    # Left free it drifted by 0.4 rad in twelve steps.
    assert np.abs(record.q[:, 7 + tarsus]).max() < 0.15


@pytest.mark.parametrize("angle", [20.0, 40.0, 60.0])
def test_hips_may_be_tilted(angle: float) -> None:
    text = (CASES / "tilted_hips_40.xml").read_text()
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    for side in ("", "-"):
        assert f"0 0.766 {side}0.643" in text
        text = text.replace(f"0 0.766 {side}0.643", f"0 {cos:.6f} {side}{sin:.6f}")
    robot = load_robot(mujoco.MjSpec.from_string(text))
    assert robot.leg_length == pytest.approx(0.74)
    leg = robot.legs["left"]
    assert robot.pin.names[leg.hip] == "left_hip_pitch"
    assert robot.pin.names[leg.knee] == "left_knee"


@pytest.mark.parametrize("name", ["missing_visual_mesh.xml", "lfs_pointer_mesh.xml"])
def test_a_mesh_that_is_only_looked_at_may_be_missing(name: str) -> None:
    robot = robot_of(name)
    file = "shell.stl" if name.startswith("missing") else "shell_lfs.stl"
    assert robot.notes[0] == f"not found or not fetched, drawn without: {file}"
    assert visual_model(robot).ngeom > robot.mj.ngeom


def test_a_missing_mesh_that_touches_is_told(tmp_path: Path) -> None:
    text = (CASES / "missing_visual_mesh.xml").read_text()
    (tmp_path / "my.xml").write_text(text.replace('mesh="shell" contype="0"', 'mesh="shell"'))
    with pytest.raises(pw.RobotError, match=r"Error opening file 'shell\.stl'"):
        load_robot(tmp_path / "my.xml")


def test_a_shape_below_the_flat_of_a_sole_is_told() -> None:
    assert (
        "a shape of 'left_foot' reaches 3.0 mm below the flat of its sole: in its own scene the "
        "foot rocks on it"
    ) in robot_of("self_collision.xml").notes


def test_shapes_that_overlap_in_the_stance_are_named() -> None:
    text = (CASES / "self_collision.xml").read_text()
    wide = text.replace(
        'fromto="0 0 -0.05 0 0 -0.33" size="0.06"', 'fromto="0 0 -0.05 0 0 -0.33" size="0.085"'
    )
    assert wide != text
    robot = load_robot(mujoco.MjSpec.from_string(wide))
    # Thighs 0.16 m apart, of 0.085 m radius.
    assert (
        "shapes that can touch overlap in the walking posture: 'left_hip' and 'right_hip' by 10.0 "
        "mm"
    ) in robot.notes


def test_what_holds_the_robot_in_its_scene_is_told() -> None:
    robot = robot_of("weld_active.xml")
    weld = "the weld 'equality_0' between 'hook' and 'pelvis'"
    assert robot.notes[0] == f"the scene holds the robot by {weld}, which is left out here"
    plan = robot.blueprint
    assert holding_constraints(plan.tree, plan.parts.base) == (weld,)
    free = robot_of("missing_visual_mesh.xml").blueprint
    assert holding_constraints(free.tree, free.parts.base) == ()


def test_passive_joints_of_both_legs_are_locked() -> None:
    """A tarsus on a spring, without a motor: the leg is one of six joints."""
    spec = mujoco.MjSpec.from_file(str(CASES / "seven_dof_tarsus.xml"))
    for side in ("left", "right"):
        spec.delete(spec.actuator(f"{side}_tarsus"))
        spec.joint(f"{side}_tarsus").stiffness[0] = 500.0
    robot = load_robot(spec)
    assert "locked, because no motor moves them: left_tarsus, right_tarsus" in robot.notes
    assert robot.joint_names == robot_of("base.mjcf").joint_names
    assert robot.leg_length == pytest.approx(0.74)


def test_a_part_of_a_scene_says_which(tmp_path: Path) -> None:
    text = (CASES / "contact_pairs.xml").read_text()
    floor = '<geom name="floor" type="plane" size="5 5 .1"/>'
    assert floor in text
    (tmp_path / "robot.xml").write_text(text.replace(floor, ""))
    (tmp_path / "scene.xml").write_text(
        f'<mujoco><include file="robot.xml"/><worldbody>{floor}</worldbody></mujoco>'
    )
    with pytest.raises(pw.RobotError, match=r"a part of 'scene\.xml', .*: give that file$"):
        load_robot(tmp_path / "robot.xml")
    assert load_robot(tmp_path / "scene.xml").sole == robot_of("contact_pairs.xml").sole


def description(folder: Path, facts: str) -> Path:
    (folder / "mini.mjcf").write_bytes((CASES / "base.mjcf").read_bytes())
    (folder / "mini.json").write_text(f'{{"model": "mini.mjcf", {facts}}}')
    return folder / "mini.json"


def test_limits_may_be_said(tmp_path: Path) -> None:
    facts = '"limits": {"left_knee": {"torque": 80, "speed": 7.5}, "right_knee": {"speed": 6}}'
    robot = load_robot(description(tmp_path, facts))
    left, right = (robot.joint_names.index(f"{side}_knee") for side in ("left", "right"))
    assert (robot.effort[left], robot.effort[right]) == (80.0, 150.0)
    assert (robot.v_limit[left], robot.v_limit[right]) == (7.5, 6.0)
    assert np.isinf(np.delete(robot.v_limit, [left, right])).all()
    assert robot.mj.actuator("left_knee").ctrlrange.tolist() == [-80.0, 80.0]


def test_limits_of_a_joint_that_there_is_not(tmp_path: Path) -> None:
    with pytest.raises(pw.RobotError, match=r"^the limits name the joint 'knee', which the model"):
        load_robot(description(tmp_path, '"limits": {"knee": {"torque": 80}}'))


def test_the_orientation_of_a_sole_may_be_said(tmp_path: Path) -> None:
    """A foot drawn with its toes pointing 0.2 rad down in the zero pose."""
    sole = '"size": [0.18, 0.08], "center": [0.03, 0, -0.04], "rpy": [0, 0.2, 0]'
    facts = ", ".join(
        f'"{side}": {{"body": "{side}_ankle_roll_link", {sole}}}' for side in ("left", "right")
    )
    robot = load_robot(description(tmp_path, f'"soles": {{{facts}}}'))
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    for foot, leg in robot.legs.items():
        level = data.oMf[robot.soles[foot].frame].rotation
        np.testing.assert_allclose(level, np.eye(3), atol=1e-9)
        tilt = level.T @ data.oMi[leg.joints[-1]].rotation
        np.testing.assert_allclose(tilt, pin.rpy.rpyToMatrix(0.0, -0.2, 0.0), atol=1e-9)
