"""Footsteps from files: what is written comes back, mistakes are told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import preview_walk as pw

PLAN = pw.FootstepPlanner(0.2, 0.17, 0.8).generate_footsteps(6, (0.3, -0.2, 0.4), turn=0.1, ramp=2)


def test_a_plan_comes_back_from_its_file(tmp_path: Path) -> None:
    again = pw.read_footsteps(pw.write_footsteps(PLAN, tmp_path / "steps.csv"))
    assert len(again) == len(PLAN)
    for step, same in zip(PLAN, again, strict=True):
        assert (same.foot, same.type, same.lift, same.land) == (
            step.foot,
            step.type,
            step.lift,
            step.land,
        )
        assert same.pose == pytest.approx(step.pose, abs=1e-12)


def test_few_columns_are_enough(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(
        "# measured on the floor\nfoot, x, y, time\nleft,0,0.085,0\nright,0,-0.085,0\n"
        "left,0.1,0.085,2.0\nright,0.2,-0.085,2.8\n"
    )
    plan = pw.read_footsteps(path)
    assert [step.type for step in plan] == ["stance", "stance", "swing_end", "swing_end"]
    assert plan.steps[1].lift == pytest.approx(2.0 + 0.2 * 0.8)
    assert plan.steps[1].pos.tolist() == [0.2, -0.085, 0.0]


def test_the_labs_dictionaries_are_read_as_json(tmp_path: Path) -> None:
    path = tmp_path / "lab.json"
    steps = [{**dict(s), "pos": s["pos"].tolist(), "lift": s.lift, "z": 0.0} for s in PLAN]
    path.write_text(json.dumps(steps))
    plan = pw.read_footsteps(path)
    assert [s.pos[:2].tolist() for s in plan] == [s.pos[:2].tolist() for s in PLAN]


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("a.csv", "", "must hold a list of two footsteps or more"),
        ("a.csv", "foot,x,y\nleft,0,0\nright,0,0", "footstep 0 must have foot, x, .*; got no time"),
        ("a.csv", "foot,x,y,time,w\nleft,0,0,0,1\nleft,0,0,0,1", "got 'w'"),
        ("a.csv", "foot,x,y,time\nleft,0,0\nright,0,0,0", "not as many cells"),
        ("a.csv", "foot,x,y,time\nleft,a,0,0\nright,0,0,0", "x of footstep 0 must be a number"),
        ("a.csv", "foot,x,y,time\nlef,0,0,0\nright,0,0,0", "foot must be 'left' or 'right'"),
        ("a.json", "[1, 2]", "footstep 0 must be an object, got 1"),
        ("a.json", "{}", "must hold a list"),
        ("a.json", "[", "holds no footsteps"),
        ("a.json", "[" * 10000, "holds no footsteps"),
        ("a.csv", "\0\0", "must hold a list|holds no footsteps"),
    ],
)
def test_a_file_without_footsteps_is_one_sentence(
    tmp_path: Path, name: str, text: str, sentence: str
) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(pw.InvalidInput, match=sentence) as found:
        pw.read_footsteps(tmp_path / name)
    assert found.value.argument == "footsteps"


def test_what_is_no_file_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(pw.InvalidInput, match="Is a directory"):
        pw.read_footsteps(tmp_path)
