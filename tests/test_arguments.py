"""Public planning calls given what no caller should give: one sentence, or a sensible result."""

from dataclasses import fields
from fractions import Fraction

import numpy as np
import pytest

from preview_walk.arguments import (
    count_of,
    finite_number,
    number_from_zero,
    positive_number,
    shown,
    time_of,
)
from preview_walk.errors import InvalidInput
from preview_walk.footsteps import gaits, goals
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.handover import refusal
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.reading import as_plan
from preview_walk.footsteps.stride import Stride
from preview_walk.footsteps.velocity import follow_velocity, saturated
from preview_walk.geometry import poses
from preview_walk.geometry.support import Sole
from preview_walk.lab.swing import SwingLegTrajectory
from preview_walk.lab.zmp import ZMPTrajectoryGenerator
from preview_walk.pattern.check import check_plan, require_walkable
from preview_walk.pattern.swing import Swing, swing_of
from preview_walk.pattern.zmp_reference import zmp_reference

ODD = [
    "text",
    "",
    b"bytes",
    None,
    1j,
    [],
    [1.0],
    [1.0, "two", 3.0],
    [[1.0], [1.0, 2.0]],
    (None, None),
    {},
    {"foot": "left"},
    np.zeros(0),
    np.zeros(1),
    np.zeros((4, 4)),
    np.full((4, 4), np.nan),
    np.array(["a", "b"]),
    np.array([1j, 2j, 3j]),
    1e308,
    -1e308,
    5e-324,
    np.nan,
    np.inf,
    -np.inf,
    10**400,
    -1,
    True,
    object(),
    len,
]
LIMITS = GaitLimits.for_leg(0.87, 0.2, Sole(0.1, 0.06))
PLANNER = FootstepPlanner(0.25, 0.2, 0.7)
PLAN = PLANNER.generate_footsteps(4)
STEP = PLAN.steps[0]
MIDDLE = 0.5 * (STEP.lift + STEP.land)
EYE, AHEAD = np.eye(4), poses.pose_at(0.3, 0.0)
SWING = Swing(EYE, AHEAD, 0.0, 1.0)
SOLES = {foot: PLAN.sole(foot, 0.0) for foot in ("left", "right")}
TIMES = np.arange(0.0, PLAN.end, 0.01)

CALLS = {
    "Sole": (Sole, {"half_length": 0.1, "half_width": 0.05}),
    "pose_at": (poses.pose_at, dict.fromkeys(("x", "y", "yaw", "z", "pitch", "roll"), 0.1)),
    "as_pose": (lambda value: poses.as_pose(value, "value"), {"value": EYE}),
    "as_heading": (lambda value: poses.as_heading(value, "value"), {"value": (1.0, 2.0)}),
    "rpy_of": (poses.rpy_of, {"pose": EYE}),
    "heading_of": (poses.heading_of, {"pose": EYE}),
    "midfeet": (poses.midfeet, {"left": EYE, "right": EYE}),
    "compose": (poses.compose, {"frame": (0.0, 0.0, 0.0), "dx": 1.0, "dy": 1.0, "dyaw": 1.0}),
    "relative": (poses.relative, {"frame": (0.0, 0.0, 0.0), "other": (0.0, 0.0, 0.0)}),
    "Footstep": (
        Footstep,
        {"foot": "left", "pose": EYE, "lift": 0.0, "land": 1.0, "type": "swing_end"},
    ),
    "FootstepPlan": (FootstepPlan, {"steps": list(PLAN), "weight_shift": 0.4}),
    "standing": (FootstepPlan.standing, {"left": EYE, "right": EYE, "start": 0.0}),
    "support": (PLAN.support, {"t": 1.0}),
    "swing_at": (PLAN.swing_at, {"t": 1.0}),
    "sole": (PLAN.sole, {"foot": "left", "t": 1.0}),
    "next_landing": (PLAN.next_landing, {"t": 1.0}),
    "next_lift": (PLAN.next_lift, {"t": 1.0}),
    "lifted": (PLAN.lifted, {"t": 1.0}),
    "is_stand": (PLAN.is_stand, {"pause": 1.0}),
    "replace_after": (PLAN.replace_after, {"t": MIDDLE, "steps": PLAN.steps[1:]}),
    "retarget": (PLAN.retarget, {"t": MIDDLE, "pose": AHEAD, "land": STEP.land}),
    "since": (PLAN.since, {"t": 1.0}),
    "transformed": (PLAN.transformed, {"pose": AHEAD}),
    "GaitLimits": (
        GaitLimits,
        {field.name: getattr(LIMITS, field.name) for field in fields(LIMITS)},
    ),
    "for_leg": (GaitLimits.for_leg, {"leg_length": 0.8, "step_width": 0.2, "sole": Sole()}),
    "problem": (LIMITS.problem, {"foot": "left", "stance": EYE, "pose": AHEAD}),
    "crossing": (LIMITS.crossing, {"foot": "left", "stance": EYE, "start": EYE, "pose": EYE}),
    "clamp": (LIMITS.clamp, {"foot": "left", "stance": (0.0, 0.0, 0.0), "goal": (0.0, 0.2, 0.0)}),
    "Stride": (Stride, {field.name: 0.5 for field in fields(Stride)}),
    "FootstepPlanner": (
        FootstepPlanner,
        {field.name: getattr(PLANNER, field.name) for field in fields(PLANNER)},
    ),
    "generate_footsteps": (
        PLANNER.generate_footsteps,
        {"n_steps": 4, "start_pos": (0.0, 0.0), "start_foot": "left", "turn": 0.1, "ramp": 1},
    ),
    "walk": (
        PLANNER.walk,
        {"strides": [Stride()], "start": (0.0, 0.0), "start_foot": "left", "limits": LIMITS},
    ),
    "stand": (PLANNER.stand, {"start": (0.0, 0.0)}),
    "get_support_phase": (PLANNER.get_support_phase, {"t": 1.0, "footsteps": PLAN}),
    "straight": (
        gaits.straight,
        {"distance": 1.0, "planner": PLANNER, "start": (0.0, 0.0), "limits": LIMITS, "ramp": 1},
    ),
    "sideways": (gaits.sideways, {"distance": 1.0, "planner": PLANNER, "limits": LIMITS}),
    "on_the_spot": (gaits.on_the_spot, {"n_steps": 4, "planner": PLANNER, "start_foot": "left"}),
    "turn_in_place": (gaits.turn_in_place, {"angle": 1.0, "planner": PLANNER, "limits": LIMITS}),
    "arc": (gaits.arc, {"radius": 2.0, "angle": 1.0, "planner": PLANNER, "ramp": 1}),
    "to_pose": (goals.to_pose, {"goal": (1.0, 0.0), "planner": PLANNER, "limits": LIMITS}),
    "from_list": (
        goals.from_list,
        {"footholds": [("left", (0.1, 0.1))], "planner": PLANNER, "step_times": [0.7]},
    ),
    "one foothold": (
        lambda foot, sole: goals.from_list([(foot, sole)], PLANNER),
        {"foot": "left", "sole": (0.1, 0.1)},
    ),
    "follow_velocity": (
        follow_velocity,
        {"plan": PLAN, "t": 0.0, "command": (0.1, 0, 0), "limits": LIMITS, "duration": 2.0},
    ),
    "saturated": (saturated, {"command": (0.1, 0.0, 0.0), "limits": LIMITS}),
    "as_plan": (as_plan, {"value": PLAN, "ratio": 0.2}),
    "refusal": (
        refusal,
        {"plan": PLAN, "current": PLAN, "t": 0.0, "limits": LIMITS, "soles": SOLES},
    ),
    "zmp_reference": (zmp_reference, {"plan": PLAN, "sole": Sole(), "margin": 0.02}),
    "ZMPReference.at": (zmp_reference(PLAN).at, {"t": 1.0}),
    "ZMPReference.velocity": (zmp_reference(PLAN).velocity, {"t": 1.0}),
    "check_plan": (
        check_plan,
        {"plan": PLAN, "limits": LIMITS, "times": TIMES, "zmp": np.zeros((len(TIMES), 2))},
    ),
    "check_plan com": (
        lambda com: check_plan(PLAN, LIMITS, TIMES, com=com),
        {"com": np.zeros((len(TIMES), 2))},
    ),
    "require_walkable": (require_walkable, {"plan": PLAN, "limits": LIMITS}),
    "Swing": (
        Swing,
        {"start": EYE, "end": AHEAD, "lift": 0.0, "land": 1.0, "swing_height": 0.05}
        | {"ground_clearance": 0.02},
    ),
    "Swing.at": (SWING.at, {"t": 0.5}),
    "Swing.retarget": (SWING.retarget, {"t": 0.5, "pose": AHEAD, "land": 1.0}),
    "swing_of": (swing_of, {"plan": PLAN, "step": STEP, "swing_height": 0.05}),
    "SwingLegTrajectory": (SwingLegTrajectory, {"swing_height": 0.05, "ground_clearance": 0.02}),
    "generate_trajectory": (
        SwingLegTrajectory().generate_trajectory,
        {"start_pos": (0, 0, 0), "end_pos": (0.3, 0, 0), "duration": 0.3, "dt": 0.01},
    ),
    "ZMPTrajectoryGenerator": (ZMPTrajectoryGenerator, {"planner": PLANNER}),
    "generate_zmp_trajectory": (
        ZMPTrajectoryGenerator(PLANNER).generate_zmp_trajectory,
        {"footsteps": PLAN, "dt": 0.01},
    ),
}
CASES = [(call, name) for call, (_, arguments) in CALLS.items() for name in arguments]


def refused(function, arguments):
    """The error that a call raises on purpose; None where it gives a result."""
    try:
        function(**arguments)
    except InvalidInput as error:
        return error
    return None


@pytest.mark.filterwarnings("ignore:Casting complex values")
@pytest.mark.parametrize(("call", "name"), CASES)
def test_what_cannot_be_is_told_in_one_sentence(call, name):
    function, good = CALLS[call]
    assert refused(function, good) is None
    for value in ODD:
        error = refused(function, {**good, name: value})
        if error is not None:
            assert error.argument is not None, (value, error)
            assert str(error).endswith("."), (value, error)
            assert len(str(error)) < 600, (value, error)


OPTIONAL = {("Stride", "width"), ("Stride", "time"), ("Stride", "double_support_ratio")}
OPTIONAL |= {("retarget", "land"), ("Swing.retarget", "land")}
NUMBERS = [
    (call, name)
    for call, name in CASES
    if isinstance(CALLS[call][1][name], float) and not call.startswith(("ZMPReference", "compose"))
]


@pytest.mark.parametrize(("call", "name"), NUMBERS)
def test_a_number_is_asked_for_where_one_is_needed(call, name):
    function, good = CALLS[call]
    for value in ("1.0", None, 1j, [1.0], np.ones(1), np.nan):
        if value is None and (call, name) in OPTIONAL:
            continue
        error = refused(function, {**good, name: value})
        assert error is not None, value
        assert error.argument == name, value


def test_numbers_of_every_kind_are_numbers():
    for value in (2, 2.0, np.float64(2.0), np.float32(2.0), np.int8(2), np.array(2.0), Fraction(2)):
        for read in (finite_number, positive_number, number_from_zero):
            number = read(value, "size", "m")
            assert (number, type(number)) == (2.0, float)
        assert time_of(value) == 2.0
    assert count_of(np.int64(3), "n") == 3
    assert time_of(-np.inf) == -np.inf


@pytest.mark.parametrize(
    ("read", "value", "sentence"),
    [
        (finite_number, 1e308, "size must be between -1e9 and 1e9 m, got 1e+308."),
        (finite_number, np.inf, "size must be finite (m), got inf."),
        (positive_number, 0, "size must be > 0 m, got 0."),
        (positive_number, 1e-12, "size must be between 1e-9 and 1e9 m, got 1e-12."),
        (positive_number, None, "size must be > 0 m, got None."),
        (number_from_zero, -1.0, "size must be >= 0 m, got -1.0."),
        (number_from_zero, 1e10, "size must be between 0 and 1e9 m, got 10000000000.0."),
        (lambda v, n, _: count_of(v, n), 200_000, "size must be at most 100000, got 200000."),
        (lambda v, n, _: count_of(v, n), 2.0, "size must be an integer >= 0, got 2.0."),
    ],
)
def test_sentences_say_what_is_allowed(read, value, sentence):
    with pytest.raises(InvalidInput) as caught:
        read(value, "size", "m")
    assert (str(caught.value), caught.value.argument) == (sentence, "size")


def test_what_came_is_shown_in_short():
    assert shown("x" * 500).startswith("'xxx")
    assert len(shown("x" * 500)) < 90
    assert shown(np.zeros((3, 2))) == "an array of shape (3, 2)"
    assert shown(np.float64(0.5)) == "0.5"
    assert shown(10**5000) == "a int"
