"""The public names: all there, documented, loaded late, the same for a type checker."""

from __future__ import annotations

import inspect
import subprocess
import sys

import pytest

import preview_walk as pw


@pytest.mark.parametrize("name", pw.__all__)
def test_every_name_is_there_and_documented(name: str) -> None:
    value = getattr(pw, name)
    if inspect.isclass(value) or inspect.isfunction(value):  # types' names and constants have none
        assert (value.__doc__ or "").strip()
    assert name in dir(pw)


def test_the_version_is_told() -> None:
    assert pw.__version__.count(".") == 2


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="No preview_walk attribute wlak"):
        _ = pw.wlak


def test_planning_alone_loads_no_engine_and_a_wrong_option_nothing_at_all() -> None:
    code = (
        "import sys, preview_walk as pw, preview_walk.cli.main\n"
        "print(sorted({'numpy', 'mujoco', 'matplotlib'} & set(sys.modules)))\n"
        "pw.FootstepPlanner(), pw.preview_gains, pw.check_plan\n"
        "print(sorted({'mujoco', 'pinocchio', 'osqp'} & set(sys.modules)))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n[]\n"


def test_every_object_is_told_in_two_lines(talos: pw.Robot) -> None:
    plan = pw.FootstepPlanner(0.2, talos.step_width, 0.8).generate_footsteps(2)
    walk = pw.Walk(talos, plan).run(until=0.02)
    record, walker, preview = walk.record(), walk.walker, pw.PreviewController(0.8, 0.005, 1.6)
    for thing in (
        *(talos, plan, plan[2], walk, walk.limits, walk.plant, walker, walker.body),
        *(walker.body.dynamics, walker.body.problem({"left": 900.0}), walker.gains),
        *(preview, preview.design, pw.zmp_reference(plan)),
        *(record, record.run, record.plans, record.plans[0], record.summary()),
        *(pw.Push(1.0, 0.2, (1.0, 2.0, 3.0)), pw.FootstepPlanner(), pw.Stride()),
    ):
        text = repr(thing)
        assert len(text) < 240, text
        assert "\n" not in text
        assert " object at 0x" not in text
