"""A file that cannot walk gives one sentence that says why."""

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from preview_walk.errors import RobotError
from preview_walk.robots.building.agreement import check_agreement
from preview_walk.robots.building.assemble import sole_name
from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import models_folder
from preview_walk.types import FEET

WALKER = (models_folder() / "humanoid-walker.xml").read_text()
BODIES = (
    "pelvis, torso, left_shoulder, left_elbow, right_shoulder, right_elbow, left_hip, left_knee, "
    "left_ankle, left_foot, right_hip, right_knee, right_ankle, right_foot"
)


def says(sentence):
    return pytest.raises(RobotError, match=f"^{re.escape(sentence)}$")


@pytest.fixture
def spec():
    """The walker without its keyframe, ready to be broken."""
    made = mujoco.MjSpec.from_string(WALKER)
    for key in list(made.keys):
        made.delete(key)
    return made


def describe(folder: Path, facts: str) -> Path:
    (folder / "walker.xml").write_text(WALKER)
    (folder / "mine.json").write_text(facts)
    return folder / "mine.json"


def test_unknown_name():
    with says(
        "unknown robot 'atlas'; expected one of alexander, g1, g1_hands, human, humanoid-walker, "
        "icub, icub27, jvrc1, romeo, simple_humanoid, talos, or the path of a .urdf or .xml file"
    ):
        load_robot("atlas")


def test_a_name_in_capitals_is_the_robots():
    assert load_robot("Humanoid-Walker").name == "humanoid-walker"


@pytest.mark.parametrize("name", ["talso", "TALO", "tallos"])
def test_a_name_with_a_slip_is_suggested(name):
    with pytest.raises(RobotError, match=f"^unknown robot '{name}'; did you mean 'talos'\\? exp"):
        load_robot(name)


def test_no_such_file():
    with says("the file 'nowhere/my.xml' does not exist"):
        load_robot("nowhere/my.xml")


def test_not_a_robot_at_all():
    with says("expected a robot's name, a path, an MjModel or an MjSpec, got int"):
        load_robot(3)


@pytest.mark.parametrize("model", ["atlas", "nowhere.xml", 3, mujoco.MjSpec()])
def test_every_refusal_names_its_argument(model):
    with pytest.raises(RobotError) as refused:
        load_robot(model)
    assert refused.value.argument == "model"


def test_unknown_mesh(tmp_path):
    path = tmp_path / "my.xml"
    text = WALKER.replace("<material", '<mesh name="m" file="gone.stl"/><material', 1)
    foot = '<geom class="sole" name="left_foot"'
    path.write_text(text.replace(foot, f'<geom type="mesh" mesh="m"/>{foot}'))
    with says(f"MuJoCo cannot compile '{path}': Error opening file 'gone.stl'"):
        load_robot(path)


def test_not_xml(tmp_path):
    path = tmp_path / "my.xml"
    path.write_text("<mujoco>")
    with pytest.raises(RobotError, match=rf"^MuJoCo cannot read '{path}': XML parse error [^\n]*$"):
        load_robot(path)


def test_one_leg(spec):
    spec.delete(spec.body("right_hip"))
    with says(
        "no two legs found: expected two limbs of at least 5 joints, the lowest of the robot, on "
        "one body; its limbs end at 'left_elbow' (3 joints), 'right_elbow' (3 joints), "
        "'left_foot' (6 joints)"
    ):
        load_robot(spec)


def test_four_joint_legs(spec):
    for foot in FEET:
        spec.delete(spec.joint(f"{foot}_ankle_roll"))
        spec.delete(spec.joint(f"{foot}_hip_yaw"))
    with says(
        "no two legs found: expected two limbs of at least 5 joints, the lowest of the robot, on "
        "one body; its limbs end at 'left_elbow' (3 joints), 'right_elbow' (3 joints), "
        "'left_ankle' (4 joints), 'right_ankle' (4 joints)"
    ):
        load_robot(spec)


def test_nothing():
    with says(
        "no two legs found: expected two limbs of at least 5 joints, the lowest of the robot, on "
        "one body; its limbs end at no joint at all"
    ):
        load_robot(mujoco.MjSpec())


def test_no_feet(spec):
    for body in ("left_foot", "right_foot"):
        for geom in list(spec.body(body).geoms):
            spec.delete(geom)
    with says(
        "the foot 'left_foot' has no shapes to find its sole from; expected geometry, or a "
        "description that gives the sole's size and centre"
    ):
        load_robot(spec)


def test_feet_like_a_ball(spec):
    for foot in FEET:
        geom = spec.geom(f"{foot}_foot")
        geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, (0.05, 0.0, 0.0)
    with says(
        "the foot 'left_foot' touches flat ground in 0.000 x 0.000 m; expected a flat sole of at "
        "least 0.01 x 0.01 m"
    ):
        load_robot(spec)


def test_no_actuators(spec):
    for motor in list(spec.actuators):
        spec.delete(motor)
    with says("the model has no motors: expected an actuator, or an effort limit, for every joint"):
        load_robot(spec)


def test_a_leg_joint_without_actuator(spec):
    spec.delete(spec.actuator("left_knee"))
    with says("the leg joint 'left_knee' has no motor; expected one on every leg joint"):
        load_robot(spec)


def test_nan_inertia(spec):
    spec.body("left_knee").inertia = (np.nan, 0.058, 0.008)
    with says(
        "the body 'left_knee' has the mass 4.5 kg and the moments of inertia "
        "(nan, 0.058, 0.008) kg·m²; expected finite numbers"
    ):
        load_robot(spec)


def test_negative_mass(spec):
    spec.body("torso").mass = -2.0
    with says("the body 'torso' has the mass -2 kg; expected zero or a positive mass"):
        load_robot(spec)


def test_ball_joint(spec):
    spec.delete(spec.joint("waist_pitch"))
    spec.delete(spec.actuator("waist_pitch"))
    spec.delete(spec.actuator("waist_yaw"))
    spec.joint("waist_yaw").type = mujoco.mjtJoint.mjJNT_BALL
    spec.joint("waist_yaw").limited = False
    with says(
        "the joint 'waist_yaw' is a ball joint, which is not supported; expected hinges in its "
        "place"
    ):
        load_robot(spec)


def test_closed_loop(spec):
    spec.add_equality(
        name="bar",
        type=mujoco.mjtEq.mjEQ_CONNECT,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1="left_hip",
        name2="left_foot",
    )
    with says(
        "the equality constraint 'bar' closes a loop between the bodies 'left_hip' and "
        "'left_foot'; expected open chains: leave the constraint out, and give the joints that it "
        "drives motors of their own"
    ):
        load_robot(spec)


def test_coupled_leg_joint(spec):
    spec.add_equality(
        type=mujoco.mjtEq.mjEQ_JOINT,
        objtype=mujoco.mjtObj.mjOBJ_JOINT,
        name1="left_ankle_roll",
        name2="left_knee",
    )
    with says(
        "the leg joint 'left_ankle_roll' is driven by 'left_knee'; every leg joint must move on "
        "its own: leave the coupling out, and give the joint a motor"
    ):
        load_robot(spec)


def test_wrong_torso(tmp_path):
    path = describe(tmp_path, '{"model": "walker.xml", "torso": "chest"}')
    with says(f"the torso names the body 'chest', which the model lacks; it has {BODIES}"):
        load_robot(path)


def test_wrong_sole(tmp_path):
    path = describe(
        tmp_path,
        '{"model": "walker.xml", "soles": {"left": {"body": "sole"}, "right": {"body": "sole"}}}',
    )
    with says(f"the left sole names the body 'sole', which the model lacks; it has {BODIES}"):
        load_robot(path)


def test_wrong_posture(tmp_path):
    path = describe(tmp_path, '{"model": "walker.xml", "posture": {"neck": 1}}')
    with pytest.raises(
        RobotError, match=r"^the posture names the joint 'neck', which the model lacks; it has .*$"
    ):
        load_robot(path)


def test_posture_outside_the_limits(tmp_path):
    path = describe(tmp_path, '{"model": "walker.xml", "posture": {"left_elbow": 1}}')
    with says("the posture puts the joint 'left_elbow' at 1; its limits are -2.3 and 0"):
        load_robot(path)


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ("{", "cannot read the description 'mine.json': "),
        ("{}", "the description 'mine.json' lacks 'model', the path of its model"),
        (
            '{"model": "walker.xml", "gain": 3}',
            "the description 'mine.json' holds gain; expected title, model, torso, soles, "
            "posture and limits only",
        ),
        (
            '{"model": "walker.xml", "soles": {"left": {"body": "left_foot"}}}',
            "the description 'mine.json' describes the soles left; expected left and right, or "
            "neither",
        ),
    ],
)
def test_odd_descriptions(tmp_path, facts, sentence):
    with pytest.raises(RobotError, match=f"^{re.escape(sentence)}"):
        load_robot(describe(tmp_path, facts))


def test_description_without_its_model(tmp_path):
    (tmp_path / "mine.json").write_text('{"model": "gone.xml"}')
    with says(f"the model file '{tmp_path / 'gone.xml'}' does not exist"):
        load_robot(tmp_path / "mine.json")


def test_engines_that_disagree():
    robot = load_robot("humanoid-walker")
    model = robot.pin.copy()
    model.armature = model.armature + 0.1
    with pytest.raises(
        RobotError,
        match=r"^MuJoCo and Pinocchio disagree about the mass matrix by 0\.00\d+ of its largest "
        r"entry; expected less than 1e-08$",
    ):
        check_agreement(robot.mj, model, {f: (sole_name(f), robot.soles[f].frame) for f in FEET})


def test_inspection_tells_instead_of_raising(spec, tmp_path):
    spec.delete(spec.body("right_hip"))
    report = inspect_robot(spec)
    assert report.robot is None
    assert report.problems[0].startswith("no two legs found")
    assert "10 bodies, 14 joints, 14 actuators" in str(report)
    with pytest.raises(RobotError, match=r"^no picture of 'the model in hand': no two legs found"):
        report.write_picture(tmp_path / "no.png")
    assert inspect_robot("nowhere.xml").problems == ("the file 'nowhere.xml' does not exist",)
