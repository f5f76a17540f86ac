"""The facts of a run: typed, unchangeable, plain JSON on the way to a file and back."""

from __future__ import annotations

import copy
import json
import pickle
import re
from math import isnan, nan
from typing import Any

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.record.run_facts import RunFacts

PUSH = {"t": 1.0, "duration": 0.2, "force": [50.0, 0.0, 0.0], "body": None, "point": None}


@pytest.fixture
def facts() -> RunFacts:
    return RunFacts(
        robot="talos",
        mass=90.0,
        gravity=9.81,
        joint_names=["hip", "knee"],  # type: ignore[arg-type]
        tau_max=np.array([100.0, np.inf]),  # type: ignore[arg-type]
        sole=(0.1, 0.05),
        omega=3.1,
        control_hz=500,
        gains={"dcm": 5.0, "posture": {"kp": [1.0, 2.0]}},
        pushes=(PUSH,),
        versions={"python": "3"},
    )


def test_facts_go_through_json_and_back(facts: RunFacts) -> None:
    again = RunFacts.from_dict(json.loads(json.dumps(facts.as_dict())))
    assert again == facts
    assert again != facts.replaced(seed=1)
    assert again.tau_max == (100.0, np.inf)
    assert isnan(again.friction)
    assert facts.as_dict()["friction"] is None
    assert facts.as_dict()["pushes"] == [PUSH]


def test_facts_pickle_copy_and_stay_unchangeable(facts: RunFacts) -> None:
    for twin in (pickle.loads(pickle.dumps(facts)), copy.deepcopy(facts), facts):
        assert twin == facts
        with pytest.raises(TypeError):
            twin.gains["dcm"] = 1.0
        with pytest.raises(TypeError):
            twin.pushes[0]["force"][0] = 0.0
        with pytest.raises(TypeError):
            twin.gains["posture"]["kp"][0] = 0.0


def test_the_callers_own_lists_are_not_kept() -> None:
    gains: dict[str, Any] = {"kp": [1.0, 2.0]}
    facts = RunFacts(control_hz=500, gains=gains)
    gains["kp"][0] = 9.0
    assert facts.gains["kp"] == (1.0, 2.0)


def test_unknown_keys_of_a_file_are_left_out_and_missing_ones_take_their_defaults() -> None:
    facts = RunFacts.from_dict({"control_hz": 200, "of the future": 1, "friction": None})
    assert facts == RunFacts(control_hz=200, friction=nan)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"mass": "heavy"}, "run fact 'mass' must be a number, got 'heavy'."),
        ({"mass": [1.0]}, "run fact 'mass' must be a number, got [1.0]."),
        ({"robot": 3}, "run fact 'robot' must be text, got 3."),
        ({"seed": 0.5}, "run fact 'seed' must be a whole number, got 0.5."),
        ({"sole": [1.0]}, "run fact 'sole' must be two numbers, got [1.0]."),
        ({"tau_max": "12"}, "run fact 'tau_max' must be numbers, got '12'."),
        ({"tau_max": 12}, "run fact 'tau_max' must be numbers, got 12."),
        ({"joint_names": [1]}, "run fact 'joint_names' must be texts, got [1]."),
        ({"gains": [1]}, "run fact 'gains' must be plain values by name, got [1]."),
        ({"fell": "no"}, "run fact 'fell' must be true or false, got 'no'."),
        ({"control_hz": 0}, "run fact 'control_hz' must be finite and > 0, got 0.0."),
        ({"control_hz": None}, "run fact 'control_hz' must be finite and > 0, got nan."),
        ({"colour": "red"}, "got 'colour'."),
    ],
)
def test_a_fact_of_the_wrong_type_gets_one_sentence(wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        RunFacts(control_hz=500).replaced(**wrong)


def test_what_json_does_not_know_is_refused() -> None:
    with pytest.raises(InvalidInput, match="run fact 'gains' must be plain values by name"):
        RunFacts(control_hz=500, gains={"bad": object()})


def test_differences_leave_out_the_circumstances(facts: RunFacts) -> None:
    assert facts.differences(facts.replaced(wall_time=3.0, command="x", versions={})) == ()
    assert facts.differences(facts.replaced(omega=3.2)) == ("omega",)
    assert facts.differences(copy.deepcopy(facts)) == ()


def test_repr_is_one_line(facts: RunFacts) -> None:
    assert repr(facts) == "RunFacts(talos, 500 Hz, did not fall)"
    assert repr(RunFacts(control_hz=200)) == "RunFacts(unknown robot, 200 Hz, did not fall)"
