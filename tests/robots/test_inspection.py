"""The reports: catalogue table and inspection."""

import numpy as np
import pytest

from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.listing import list_robots
from preview_walk.robots.load import load_robot
from preview_walk.robots.problems import one_leg_torques
from preview_walk.robots.reading.description import catalogue, models_folder


def test_the_table_has_every_robot():
    head, *rows = list_robots().splitlines()
    assert " ".join(head.split()) == "name robot mass (kg) joints leg (m) CoM (m) sole (m)"
    assert tuple(row.split()[0] for row in rows) == catalogue()
    talos = next(row for row in rows if row.startswith("talos"))
    assert talos.split()[-8:] == ["hands)", "90.3", "32", "0.812", "0.876", "0.210", "x", "0.130"]


def test_a_good_robot_has_no_problems():
    report = inspect_robot(models_folder() / "humanoid-walker.xml")
    assert report.problems == ()
    text = str(report)
    for line in (
        "65.0 kg, 20 joints, 20 motors",
        "base 'pelvis', trunk 'torso'",
        "left sole on 'left_foot': 0.200 x 0.085 m",
        "speed limits: none of the joints has any",
        "arms and trunk as in the keyframe 'stand'",
    ):
        assert f"  - {line}\n" in text
    assert text.endswith("will not work:\n  nothing")


def test_motors_too_weak_to_stand_are_named():
    problems = inspect_robot("simple_humanoid").problems
    assert problems == (
        "the joint 'LLEG_HIP_R' needs 132.9 N·m to stand on one leg, its motor gives 100.0 N·m",
    )


@pytest.mark.parametrize("name", ["talos", "humanoid-walker"])
def test_one_leg_torques_hold_the_weight(name):
    """The other leg only hangs; the standing hip carries the pelvis, which hangs beside it."""
    robot = load_robot(name)
    torques = dict(zip(robot.joint_names, one_leg_torques(robot), strict=True))
    rolls = sorted(np.abs(list(torques.values())))[-2:]
    heaviest = max(torques, key=lambda joint: abs(torques[joint]))
    assert "left" in heaviest
    assert rolls[1] < 0.5 * robot.mass * 9.81 * robot.step_width * 1.5


def test_the_picture_shows_robot_and_soles(tmp_path):
    from matplotlib.image import imread

    inspect_robot("humanoid-walker").write_picture(tmp_path / "stance.png")
    image = imread(tmp_path / "stance.png")[..., :3]
    assert image.shape == (640, 960, 3)
    red, green = (
        image[..., i] - image.max(axis=2, initial=0, where=mask)
        for i, mask in (
            (0, np.array([False, True, True])),
            (1, np.array([True, False, True])),
        )
    )
    assert (red > 0.3).sum() > 100
    assert (green > 0.1).sum() > 100
