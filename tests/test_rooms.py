"""The house has one direction: a room imports those below it; no two files import each other."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import preview_walk

PACKAGE = Path(preview_walk.__file__).parent
ARCHITECTURE = PACKAGE.parent / "docs" / "architecture.md"
MAX_LINES, MAX_FUNCTION, MAX_ARGUMENTS = 300, 50, 5

MORE_ARGUMENTS = {"pose_at", "PreviewController.__init__"}
"""Six numbers, no value: the coordinates of a pose, the walking lab's parameters."""

SERVICES = {
    "arguments",
    "constants",
    "errors",
    "extras",
    "files",
    "html",
    "offscreen",
    "stopping",
    "threads",
    "types",
}
"""Files that serve all rooms; they import each other alone."""

FACES = {"preview_walk", "__main__"}
"""What stands above all rooms."""


def imports(path: Path) -> set[str]:
    """Return the modules of the package that a file imports, wherever in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("preview_walk."):
            names.add(str(node.module))
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names if alias.name.startswith("preview_walk.")}
    return names & set(MODULES)


def module_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def room_of(module: str) -> str:
    return module.split(".")[1] if "." in module else module


MODULES = {module_of(path): path for path in PACKAGE.rglob("*.py")}
GRAPH = {module: imports(path) - {module} for module, path in MODULES.items()}


def order() -> list[str]:
    """Return the rooms from the lowest to the highest, as the architecture's table has them."""
    return re.findall(r"^\| `(\w+)(?:/|\.py)` \|", ARCHITECTURE.read_text(encoding="utf-8"), re.M)


def test_the_architecture_names_every_room() -> None:
    assert {room_of(module) for module in MODULES} == {*order(), *SERVICES, *FACES}


def test_every_arrow_points_down() -> None:
    height = {room: level for level, room in enumerate(order(), 1)}
    height |= dict.fromkeys(SERVICES, 0) | dict.fromkeys(FACES, len(height) + 1)
    up = [
        f"{module} -> {other}"
        for module, others in GRAPH.items()
        for other in others
        if height[room_of(other)] > height[room_of(module)]
    ]
    assert up == []


def test_no_two_files_import_each_other() -> None:
    try:
        TopologicalSorter(GRAPH).prepare()
    except CycleError as circle:
        pytest.fail(f"a circle of imports: {circle.args[1]}")


def test_every_room_says_what_it_is_for() -> None:
    for path in PACKAGE.rglob("__init__.py"):
        text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        assert len(text) > 60, path


def test_every_room_says_what_it_imports() -> None:
    """By name, or that it imports everything below it."""
    for room in order():
        path = PACKAGE / room / "__init__.py"
        text = ast.get_docstring(ast.parse(path.read_text())) or "" if path.exists() else ""
        others = {room_of(o) for m, others in GRAPH.items() if room_of(m) == room for o in others}
        for other in others - {room, *SERVICES, *FACES}:
            assert not path.exists() or "everything below it" in text or f"{other}" in text, room


FILES = [
    path
    for folder in ("preview_walk", "benchmarks", "examples", "docs", "tests")
    for path in (PACKAGE.parent / folder).rglob("*.py")
]


def functions(path: Path) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Yield the functions of a file, those of classes with the class's name."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.FunctionDef):
                owner = f"{node.name}." if isinstance(node, ast.ClassDef) else ""
                yield owner + child.name, child


def lines_of(function: ast.FunctionDef) -> int:
    """Return the lines of a function's code; a docstring may be as long as its arguments ask."""
    first = function.body[0]
    doc = 0
    if ast.get_docstring(function) is not None:
        doc = (first.end_lineno or 0) - first.lineno + 1
    return (function.end_lineno or 0) - function.lineno + 1 - doc


def test_no_file_is_longer_than_can_be_read_at_a_sitting() -> None:
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    assert {path: n for path, n in lines.items() if n > MAX_LINES} == {}


def test_no_function_is_longer_than_a_screen() -> None:
    lines = {(path, name): lines_of(node) for path in FILES for name, node in functions(path)}
    assert {where: n for where, n in lines.items() if n > MAX_FUNCTION} == {}


def test_no_call_needs_more_than_five_arguments_in_order() -> None:
    """What follows by keyword are options, each named where it is given."""
    many = {}
    for path in FILES:
        if "tests" in path.relative_to(PACKAGE.parent).parts:
            continue
        for name, node in functions(path):
            taken = [a.arg for a in (*node.args.posonlyargs, *node.args.args)]
            count = len(taken) - (taken[:1] in (["self"], ["cls"]))
            if count > MAX_ARGUMENTS and name not in MORE_ARGUMENTS:
                many[path, name] = count
    assert many == {}
