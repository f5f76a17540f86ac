"""The public names: all there, loaded late, the same for a type checker."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import preview_walk as pw


@pytest.mark.parametrize("name", pw.__all__)
def test_every_name_is_there_and_documented(name: str) -> None:
    assert (getattr(pw, name).__doc__ or "").strip()
    assert name in dir(pw)


def test_type_checkers_see_the_same_names_from_the_same_places() -> None:
    tree = ast.parse(Path(str(pw.__file__)).read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    seen = {
        alias.name: str(node.module).removeprefix("preview_walk.")
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert seen == pw._HOME_OF
    assert sorted(seen) == sorted(pw.__all__)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'preview_walk' has no attribute 'wlak'"):
        _ = pw.wlak


def test_planning_alone_loads_no_engine_and_a_wrong_option_nothing_at_all() -> None:
    code = (
        "import sys, preview_walk as pw, preview_walk.cli\n"
        "print(sorted({'numpy', 'mujoco', 'matplotlib'} & set(sys.modules)))\n"
        "pw.FootstepPlanner(), pw.preview_gains, pw.check_plan\n"
        "print(sorted({'mujoco', 'pinocchio', 'osqp'} & set(sys.modules)))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n[]\n"
