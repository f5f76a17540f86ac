"""What a model file does not say about a robot: one small JSON file per robot in `models/`."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path
from typing import Any, NoReturn

from preview_walk.errors import RobotError
from preview_walk.geometry.support import Sole
from preview_walk.robots.bounds import LARGEST, SMALLEST_SOLE
from preview_walk.robots.reading.content import is_there, shown
from preview_walk.types import FEET, Foot

SHIPPED = "example-robot-data:"
"""Start of a description's `model` that names a file of the package example-robot-data."""


@dataclass(frozen=True)
class SoleFact:
    """Where a sole is.

    Attributes:
        body: name of the body.
        size: its rectangle; None to find rectangle and centre from the body's shapes.
        center: of the rectangle in the body, m.
    """

    body: str
    size: Sole | None = None
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Description:
    """Facts about a robot that its model file does not hold: no gain, weight or timing.

    Attributes:
        name: short name.
        title: name to be read.
        model: a path, or "example-robot-data:PATH" for a file that this package ships.
        torso: the body that is kept upright; None to find it.
        soles: where the soles are; empty to find them.
        posture: joint angles (rad) of the walking posture by name, the legs' left to inverse
            kinematics.
    """

    name: str
    title: str
    model: str
    torso: str | None = None
    soles: Mapping[Foot, SoleFact] = field(default_factory=dict)
    posture: Mapping[str, float] = field(default_factory=dict)


def models_folder() -> Path:
    """Return the folder of descriptions: inside the wheel, or beside the package in a checkout."""
    inside = Path(str(files("preview_walk"))) / "models"
    return inside if inside.is_dir() else inside.parent.parent / "models"


def catalogue() -> tuple[str, ...]:
    """Return the names of the robots that `load_robot` knows, sorted."""
    return tuple(sorted(path.stem for path in models_folder().glob("*.json")))


def describe(name: str | Path) -> Description:
    """Return the description of a robot.

    Args:
        name: of the catalogue, or the path of a .json, .urdf, .xml or .mjcf file.

    Raises:
        RobotError: an unknown name, or a file that does not exist.
    """
    path = Path(name)
    if path.suffix.lower() not in (".json", ".urdf", ".xml", ".mjcf"):
        path = models_folder() / f"{_known(str(name))}.json"
    if not is_there(path):
        raise RobotError(f"the file '{shown(path)}' does not exist", argument="model")
    if path.suffix.lower() == ".json":
        return read_description(path)
    return Description(path.stem, path.stem, str(path.resolve()))


def _known(name: str) -> str:
    """Return the catalogue's name for what was typed, capitals or not."""
    known = catalogue()
    if name.lower() in known:
        return name.lower()
    near = get_close_matches(name.lower(), known, n=1, cutoff=0.75)
    meant = f"; did you mean '{near[0]}'?" if near else ";"
    raise RobotError(
        f"unknown robot '{shown(name)}'{meant} expected one of {', '.join(known)}, "
        "or the path of a .urdf or .xml file",
        argument="model",
    )


def read_description(path: Path) -> Description:
    """Return the description in a JSON file.

    Raises:
        RobotError: the file is no description; says which fact is missing or odd.
    """
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise RobotError(f"cannot read the description '{path.name}': {error}") from error
    return _Facts(path.name, facts).description(path)


@dataclass(frozen=True)
class _Facts:
    """The facts in a description file, checked as they are taken."""

    file: str
    facts: Any

    def description(self, path: Path) -> Description:
        """Return the description; `path` is the file, beside which the model is looked for."""
        self._is_object("facts", self.facts, ("title", "model", "torso", "soles", "posture"))
        if "model" not in self.facts:
            raise RobotError(f"the description '{self.file}' lacks 'model', the path of its model")
        model = self._text("model", self.facts["model"])
        if not model.startswith(SHIPPED):
            model = str((path.parent / model).resolve())
        return Description(
            path.stem,
            self._text("title", self.facts.get("title", path.stem)),
            model,
            self._text("torso", self.facts["torso"]) if "torso" in self.facts else None,
            self._soles(self.facts.get("soles", {})),
            self._posture(self.facts.get("posture", {})),
        )

    def _soles(self, soles: Any) -> dict[Foot, SoleFact]:
        if isinstance(soles, dict) and set(soles) not in (set(), set(FEET)):
            raise RobotError(
                f"the description '{self.file}' describes the soles {', '.join(sorted(soles))}; "
                "expected left and right, or neither"
            )
        self._is_object("soles", soles, FEET)
        return {foot: self._sole(f"soles.{foot}", soles[foot]) for foot in FEET if foot in soles}

    def _sole(self, name: str, sole: Any) -> SoleFact:
        self._is_object(name, sole, ("body", "size", "center"))
        if "body" not in sole:
            raise RobotError(f"the description '{self.file}' lacks '{name}.body', a body's name")
        size = None
        if "size" in sole:
            length, width = self._numbers(f"{name}.size", sole["size"], 2)
            if min(length, width) < SMALLEST_SOLE:
                self._refuse(
                    f"{name}.size", sole["size"], f"a length and width >= {SMALLEST_SOLE} m"
                )
            size = Sole(length / 2, width / 2)
        x, y, z = self._numbers(f"{name}.center", sole.get("center", (0.0, 0.0, 0.0)), 3)
        return SoleFact(self._text(f"{name}.body", sole["body"]), size, (x, y, z))

    def _posture(self, posture: Any) -> dict[str, float]:
        if not isinstance(posture, dict):
            self._refuse("posture", posture, "an object of joint angles in rad by joint name")
        return {
            joint: self._numbers(f"posture.{joint}", [angle], 1)[0]
            for joint, angle in posture.items()
        }

    def _is_object(self, name: str, value: Any, keys: Collection[str]) -> None:
        """Raise `RobotError` unless a value is an object of some of these keys."""
        wanted = f"{', '.join(list(keys)[:-1])} and {list(keys)[-1]}"
        if not isinstance(value, dict):
            self._refuse(name, value, f"an object that holds {wanted}")
        unknown = set(value) - set(keys)
        if unknown:
            where = "" if name == "facts" else f" in '{name}'"
            raise RobotError(
                f"the description '{self.file}' holds {', '.join(sorted(unknown))}{where}; "
                f"expected {wanted} only"
            )

    def _text(self, name: str, value: Any) -> str:
        if not isinstance(value, str) or not value or "\0" in value:
            self._refuse(name, value, "a text")
        return str(value)

    def _numbers(self, name: str, values: Any, count: int) -> list[float]:
        """Return finite numbers of a size that a robot can have."""
        numbers = isinstance(values, (list, tuple)) and len(values) == count
        if not numbers or not all(_is_number(value) for value in values):
            wanted = "a number" if count == 1 else f"{count} numbers"
            self._refuse(name, values[0] if count == 1 else values, f"{wanted} up to {LARGEST:g}")
        return [float(value) for value in values]

    def _refuse(self, name: str, value: Any, wanted: str) -> NoReturn:
        text = json.dumps(value)
        text = text if len(text) <= 40 else f"{text[:40]}..."
        raise RobotError(f"the description '{self.file}' says {name}: {text}; expected {wanted}")


def _is_number(value: Any) -> bool:
    """Return whether a value is a finite number, and not absurdly large."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= LARGEST


def model_path(model: str) -> Path:
    """Return the file that a description's `model` names."""
    if model.startswith(SHIPPED):
        return example_robot_data() / model.removeprefix(SHIPPED)
    return Path(model)


def example_robot_data() -> Path:
    """Return the folder of robots that the package example-robot-data ships (data only)."""
    from importlib.metadata import PackageNotFoundError, distribution

    try:
        package = distribution("example-robot-data")
    except PackageNotFoundError as missing:
        raise RobotError(
            "example-robot-data is not installed; expected it for the robots of the catalogue"
        ) from missing
    return Path(str(package.locate_file("cmeel.prefix/share/example-robot-data/robots")))
