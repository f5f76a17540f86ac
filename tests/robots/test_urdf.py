"""URDFs of the walker, written in many ways."""

import re
import xml.etree.ElementTree as ElementTree
from functools import cache
from itertools import pairwise

import mujoco
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from robots.urdf_text import add_box, urdf_of

from preview_walk.errors import RobotError
from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.load import load_robot, visual_model
from preview_walk.types import FEET

original = cache(lambda: load_robot("humanoid-walker"))


@pytest.fixture
def urdf():
    return urdf_of(original())


@pytest.fixture
def load(tmp_path):
    def write(root):
        path = tmp_path / "walker.urdf"
        ElementTree.ElementTree(root).write(path)
        return load_robot(path)

    return write


def joint(root, name):
    return root.find(f"joint[@name='{name}']")


def test_urdf_and_mjcf_are_the_same_robot(urdf, load):
    robot = load(urdf)
    assert robot.mass == pytest.approx(original().mass + 0.007, abs=1e-6)  # seven virtual links
    assert robot.joint_names == original().joint_names
    np.testing.assert_allclose(robot.effort, original().effort)
    assert robot.com_height == pytest.approx(original().com_height, abs=1e-3)
    assert robot.leg_length == pytest.approx(original().leg_length)
    np.testing.assert_allclose(robot.v_limit, 9.5)
    np.testing.assert_allclose(robot.damping, 0.5)
    for foot in FEET:
        assert robot.soles[foot].half_length == pytest.approx(0.1)
        assert robot.soles[foot].half_width == pytest.approx(0.0425)
    assert robot.notes[0].startswith("no mass (1 g assumed): torso_0, ")


def test_a_root_link_that_is_a_mere_frame(urdf, load):
    ElementTree.SubElement(urdf, "link", name="base_footprint")
    element = ElementTree.SubElement(urdf, "joint", name="mount", type="fixed")
    ElementTree.SubElement(element, "parent", link="base_footprint")
    ElementTree.SubElement(element, "child", link="pelvis")
    ElementTree.SubElement(element, "origin", xyz="0 0 0.93")
    robot = load(urdf)
    assert robot.com_height == pytest.approx(original().com_height, abs=1e-3)


@pytest.mark.parametrize("kind", ["floating", "fixed"])
def test_a_link_called_world(urdf, load, kind):
    ElementTree.SubElement(urdf, "link", name="world")
    element = ElementTree.SubElement(urdf, "joint", name="to_world", type=kind)
    ElementTree.SubElement(element, "parent", link="world")
    ElementTree.SubElement(element, "child", link="pelvis")
    assert load(urdf).joint_names == original().joint_names


def test_limits_missing_or_zero(urdf, load):
    for name in ("left_elbow", "right_elbow"):
        joint(urdf, name).remove(joint(urdf, name).find("limit"))
    joint(urdf, "waist_yaw").find("limit").set("effort", "0")
    joint(urdf, "waist_pitch").find("limit").set("velocity", "0")
    robot = load(urdf)
    at = robot.joint_names.index
    assert np.isinf(robot.q_upper[at("left_elbow")])
    assert np.isinf(robot.v_limit[at("waist_pitch")])
    assert robot.effort[at("waist_yaw")] == pytest.approx(3.0 * robot.mass)
    assert (
        "no torque limit: 195 N·m (3 N·m per kg) assumed for waist_yaw, left_elbow, right_elbow"
    ) in robot.notes


def test_a_mimic_joint_is_locked(urdf, load):
    ElementTree.SubElement(joint(urdf, "right_elbow"), "mimic", joint="left_elbow")
    robot = load(urdf)
    assert "right_elbow" not in robot.joint_names
    assert "locked, because another joint drives them: right_elbow" in robot.notes


def test_a_leg_joint_that_mimics_is_refused(urdf, load):
    ElementTree.SubElement(joint(urdf, "right_hip_yaw"), "mimic", joint="left_hip_yaw")
    with pytest.raises(
        RobotError,
        match=r"^the leg joint 'right_hip_yaw' is driven by 'left_hip_yaw'; "
        "every leg joint must move on its own: leave the coupling out, and give the joint a motor$",
    ):
        load(urdf)


def test_point_masses_are_given_a_size(urdf, load):
    moments = urdf.find("link[@name='left_ankle']/inertial/inertia")
    for key in moments.attrib:
        moments.set(key, "0")
    robot = load(urdf)
    assert "mass but no inertia (a solid ball's assumed): left_ankle" in robot.notes
    radius = (3 * 0.5 / (4 * np.pi * 1000)) ** (1 / 3)
    np.testing.assert_allclose(
        robot.mj.body("left_ankle").inertia, 0.4 * 0.5 * radius**2, rtol=1e-9
    )


def test_an_inertia_no_solid_has_is_raised(urdf, load):
    urdf.find("link[@name='left_ankle']/inertial/inertia").set("ixx", "0.01")
    robot = load(urdf)
    assert "an inertia that no solid has (the small moments raised): left_ankle" in robot.notes


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (
            lambda root: root.find("link[@name='torso']/inertial/mass").set("value", "-21.6"),
            "the body 'torso' has the mass -21.6 kg; expected zero or a positive mass",
        ),
        (
            lambda root: root.find("link[@name='torso']/inertial/inertia").set("iyy", "nan"),
            "the body 'torso' has the mass 21.6 kg and the moments of inertia "
            "(0.62, nan, 0.25) kg·m²; expected finite numbers",
        ),
        (
            lambda root: root.find("link[@name='torso']/inertial/inertia").set("iyy", "-1"),
            "the body 'torso' has the principal inertia -1 kg·m²; "
            "expected zero or positive inertias",
        ),
        (
            lambda root: joint(root, "left_knee").set("type", "planar"),
            "the joint 'left_knee' is of type 'planar'; "
            "expected revolute, continuous, prismatic or fixed",
        ),
        (
            lambda root: joint(root, "left_knee").find("axis").set("xyz", "0 0 0"),
            "the joint 'left_knee' has a zero axis; expected a direction",
        ),
        (
            lambda root: joint(root, "left_knee").find("axis").set("xyz", "0 1"),
            'the URDF holds xyz="0 1"; expected 3 number(s)',
        ),
        (
            lambda root: joint(root, "left_knee").find("limit").set("upper", "-1"),
            "the joint 'left_knee' has the lower limit 0 above the upper limit -1",
        ),
        (
            lambda root: joint(root, "left_knee").find("parent").set("link", "thigh"),
            "the joint 'left_knee' names the parent link 'thigh', which the URDF lacks",
        ),
        (
            lambda root: root.remove(joint(root, "left_knee")),
            "'walker.urdf' has 2 root links (pelvis, left_knee); expected one",
        ),
        (
            lambda root: joint(root, "left_knee").set("type", "fixed"),
            "the leg from 'left_hip_yaw' to 'left_ankle_roll' has 2 joint(s) about the lateral "
            "axis (left_hip_pitch, left_ankle_pitch); expected hip, knee and ankle",
        ),
    ],
)
def test_broken_urdfs(urdf, load, spoil, sentence):
    spoil(urdf)
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}$"):
        load(urdf)


def test_not_a_urdf(tmp_path):
    path = tmp_path / "my.urdf"
    path.write_text("<mujoco/>")
    sentence = f"'{path}' holds <mujoco>; expected a URDF, whose root is <robot>"
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}$"):
        load_robot(path)


def test_a_foot_mesh_that_is_missing(urdf, load):
    link = urdf.find("link[@name='left_foot']")
    mesh = ElementTree.SubElement(link.find("collision"), "geometry")
    link.find("collision").remove(link.find("collision/geometry"))
    ElementTree.SubElement(mesh, "mesh", filename="package://walker/foot.stl")
    sentence = (
        "the foot 'left_foot' needs the mesh 'package://walker/foot.stl', which is not found or "
        "not readable; expected the file, or a description that gives the sole's size and centre"
    )
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}$"):
        load(urdf)


def test_looks_that_are_missing_do_not_matter(urdf, load, tmp_path):
    element = add_box(urdf.find("link[@name='torso']"), "0.2 0.3 0.4", "0 0 0.2", "visual")
    material = ElementTree.SubElement(element, "material", name="blue")
    ElementTree.SubElement(material, "color", rgba="0 0 1 1")
    lost = ElementTree.SubElement(urdf.find("link[@name='pelvis']"), "visual")
    ElementTree.SubElement(
        ElementTree.SubElement(lost, "geometry"), "mesh", filename="package://walker/pelvis.dae"
    )
    robot = load(urdf)
    seen = visual_model(robot)
    assert any((rgba == (0, 0, 1, 1)).all() for rgba in seen.geom_rgba)
    assert (
        "visual meshes that are not found or not readable: package://walker/pelvis.dae"
        in inspect_robot(tmp_path / "walker.urdf").missing
    )


def test_a_robot_without_looks_is_drawn_as_bones(urdf, load):
    seen = visual_model(load(urdf))
    assert (seen.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE).sum() > 10


def test_model_compiled_from_a_urdf(urdf):
    """MuJoCo fuses a URDF's root link into the world, where its mass is lost."""
    for link in urdf.findall("link"):
        if link.find("inertial") is None:
            inertial = ElementTree.SubElement(link, "inertial")
            ElementTree.SubElement(inertial, "mass", value="0.001")
            ElementTree.SubElement(
                inertial, "inertia", ixx="1e-5", iyy="1e-5", izz="1e-5", ixy="0", ixz="0", iyz="0"
            )
    mj = mujoco.MjModel.from_xml_string(ElementTree.tostring(urdf, encoding="unicode"))
    sentence = (
        "the limbs hang on the world: the robot has no base body (MuJoCo fuses a URDF's root link "
        "into the world); expected a base with a mass, or the .urdf file itself"
    )
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}$"):
        load_robot(mj)


def test_a_urdf_that_is_called_xml(urdf, tmp_path):
    ElementTree.ElementTree(urdf).write(tmp_path / "walker.xml")
    assert load_robot(tmp_path / "walker.xml").joint_names == original().joint_names


@pytest.mark.parametrize("kind", ["prismatic", "planar"])
def test_massless_joints_that_carry_the_root(urdf, load, kind):
    """As in models for planners: the base's own degrees of freedom, drawn as joints."""
    count = 1 if kind == "planar" else 6
    names = [f"carrier_{i}" for i in range(count)] + ["pelvis"]
    for i, (above, below) in enumerate(pairwise(names)):
        ElementTree.SubElement(urdf, "link", name=above)
        turning = kind == "prismatic" and i > 2
        element = ElementTree.SubElement(
            urdf, "joint", name=f"virtual_{i}", type="revolute" if turning else kind
        )
        ElementTree.SubElement(element, "parent", link=above)
        ElementTree.SubElement(element, "child", link=below)
    robot = load(urdf)
    assert robot.joint_names == original().joint_names
    virtual = ", ".join(f"virtual_{i}" for i in range(count))
    assert f"joints between world and base became a free joint: {virtual}" in robot.notes


@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    place=st.integers(0, 10**6),
    number=st.sampled_from(("nan", "inf", "-inf", "1e30", "-1e30", "1e-300", "-1", "", "x")),
)
def test_any_number_of_a_urdf_is_taken_or_told(tmp_path, place, number):
    text = ElementTree.tostring(urdf_of(original()), encoding="unicode")
    spots = [match.span() for match in re.finditer(r"(?<=[\" ])-?\d+\.\d+(?=[\" ])", text)]
    start, end = spots[place % len(spots)]
    (tmp_path / "walker.urdf").write_text(text[:start] + number + text[end:])
    report = inspect_robot(tmp_path / "walker.urdf")
    if report.robot is None:
        assert "\n" not in report.problems[0]
    else:
        assert np.isfinite(report.robot.posture).all()
        assert 1.0 < report.robot.mass < 1e4
