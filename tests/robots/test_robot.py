"""A robot as a value: copies that walk alike, read-only arrays, one sole, one line."""

import copy
import pickle
from dataclasses import replace

import joblib
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.load import load_robot, visual_model
from preview_walk.robots.robot import Robot

COPIES = {
    "pickled": lambda robot: pickle.loads(pickle.dumps(robot)),
    "deep-copied": copy.deepcopy,
    "copied twice": lambda robot: copy.deepcopy(pickle.loads(pickle.dumps(robot))),
}
ARRAYS = ("effort", "q_lower", "q_upper", "v_limit", "damping", "posture")


def walked(robot: Robot) -> pw.Record:
    planner = pw.FootstepPlanner(0.2 * robot.leg_length, robot.step_width, 0.8)
    return pw.simulate(robot, planner.generate_footsteps(1))


@pytest.fixture(scope="module", params=["humanoid-walker", "romeo"])
def robot(request):
    """One from MJCF, one from a URDF with joints locked or motors assumed."""
    return load_robot(request.param)


@pytest.fixture(scope="module")
def record(robot):
    return walked(robot)


@pytest.mark.parametrize("copied", COPIES.values(), ids=list(COPIES))
def test_a_copy_walks_bit_for_bit_as_the_original(robot, record, copied):
    assert walked(copied(robot)).physical_equal(record)


def test_a_copy_in_another_process_walks_bit_for_bit_as_the_original(robot, record):
    jobs = joblib.Parallel(n_jobs=2, backend="loky")
    (there,) = jobs([joblib.delayed(walked)(robot)])
    assert there.physical_equal(record)


@pytest.mark.parametrize("copied", COPIES.values(), ids=list(COPIES))
def test_a_copy_is_drawn_as_the_original(robot, copied):
    one, two = visual_model(robot), visual_model(copied(robot))
    assert one.ngeom == two.ngeom > robot.mj.ngeom
    np.testing.assert_array_equal(one.geom_pos, two.geom_pos)
    np.testing.assert_array_equal(one.mesh_vert, two.mesh_vert)


@pytest.mark.parametrize("copied", COPIES.values(), ids=list(COPIES))
def test_read_only_arrays_stay_so(robot, copied):
    other = copied(robot)
    for name in ARRAYS:
        for owner in (robot, other):
            with pytest.raises(ValueError, match="read-only"):
                getattr(owner, name)[0] = 1.0
        np.testing.assert_array_equal(getattr(other, name), getattr(robot, name))


def test_an_array_of_the_callers_stays_the_callers(robot):
    speeds = np.full(len(robot.v_limit), 3.0)
    slow = replace(robot, v_limit=speeds)
    speeds[0] = 9.0
    assert slow.v_limit[0] == 3.0


def test_what_is_changed_in_a_copy_stays_in_the_copy(robot):
    other = copy.deepcopy(robot)
    other.mj.body_mass[1] += 1.0
    other.pin.armature = other.pin.armature + 1.0
    assert robot.mj.body_mass[1] == load_robot(robot.name).mj.body_mass[1]
    assert (robot.pin.armature[:6] == 0.0).all()


def test_the_sole_lies_within_both(robot):
    left, right = robot.soles["left"], robot.soles["right"]
    assert robot.sole == left.size == right.size
    narrow = replace(left, size=pw.Sole(0.09, 0.5 * left.half_width))
    odd = replace(robot, soles={"left": narrow, "right": right})
    assert odd.sole == pw.Sole(min(0.09, right.half_length), 0.5 * left.half_width)


def test_every_value_says_itself_in_one_line(robot):
    assert repr(load_robot("talos")) == ("<Robot 'talos': 90.3 kg, 32 joints, legs of 0.812 m>")
    report = inspect_robot("humanoid-walker")
    assert repr(report) == "<Inspection of 'humanoid-walker': 0 problem(s)>"
    plan = robot.blueprint
    for value in (robot, plan, plan.tree, plan.urdf, plan.soles["left"], robot.soles["left"]):
        assert "\n" not in repr(value)
        assert len(repr(value)) < 300
