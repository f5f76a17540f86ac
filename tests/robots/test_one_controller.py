"""One controller for all robots: none is named outside its description."""

import ast
import re
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

import preview_walk
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import catalogue
from preview_walk.robots.reading.facts import Description, SoleFact

PACKAGE = Path(preview_walk.__file__).parent

DEFAULT_ROBOT = ("cli/option_table.py", "talos")
"""The robot that walks where none is named."""

COMMON = {"left_foot", "right_foot"}
"""Bodies whose names are words of the record too."""


def words(tree: ast.AST) -> Iterator[str]:
    """Yield the names and texts in code, without docstrings (comments are not in the tree)."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    told = {
        id(node.value)
        for body in ast.walk(tree)
        if isinstance(body, documented)
        for node in body.body
        if isinstance(node, ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            if id(node) not in told:
                yield node.value
        elif isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.Attribute):
            yield node.attr


def test_no_robot_and_none_of_its_parts_is_named_in_the_code() -> None:
    robots = [load_robot(name) for name in catalogue()]
    names = {robot.name for robot in robots}
    names |= {joint for robot in robots for joint in robot.joint_names}
    names |= {sole.body for robot in robots for sole in robot.blueprint.soles.values()}
    names -= {name for name in names if name.lower() in COMMON}
    pattern = re.compile(rf"(?<![a-z0-9])({'|'.join(map(re.escape, names))})(?![a-z0-9])", re.I)
    found = {
        (str(path.relative_to(PACKAGE)), match.group(1))
        for path in PACKAGE.rglob("*.py")
        for word in words(ast.parse(path.read_text()))
        for match in pattern.finditer(word)
    }
    assert found == {DEFAULT_ROBOT}


def test_a_description_holds_facts_only() -> None:
    """No gain, weight or timing has a place in it."""
    assert [field.name for field in fields(Description)] == [
        "name",
        "title",
        "model",
        "torso",
        "soles",
        "posture",
        "limits",
    ]
    assert [field.name for field in fields(SoleFact)] == ["body", "size", "center", "rpy"]
