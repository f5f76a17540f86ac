"""What a model file does not say about a robot: one small JSON file per robot in `models/`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from preview_walk.errors import RobotError
from preview_walk.types import FEET, Foot

SHIPPED = "example-robot-data:"
"""Start of a description's `model` that names a file of the package example-robot-data."""


@dataclass(frozen=True)
class SoleFact:
    """Where a sole is: body or frame name, size (length, width) in m, its centre in the body.

    Without a size both are found from the body's shapes.
    """

    body: str
    size: tuple[float, float] | None = None
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Description:
    """Facts about a robot that its model file does not hold: no gain, weight or timing.

    `model` is a path, or "example-robot-data:PATH" for a file that package ships. `torso` (a body)
    and `soles` are found where they are not given; `posture` holds joint angles (rad) of the
    walking posture, the legs' left to inverse kinematics.
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
    """Return the description of a robot of the catalogue, of a .json, .urdf or .xml file.

    Raises `RobotError` for an unknown name or a file that does not exist.
    """
    path = Path(name)
    if path.suffix.lower() not in (".json", ".urdf", ".xml", ".mjcf"):
        if str(name) not in catalogue():
            raise RobotError(
                f"unknown robot '{name}'; expected one of {', '.join(catalogue())}, "
                "or the path of a .urdf or .xml file"
            )
        path = models_folder() / f"{name}.json"
    if not path.is_file():
        raise RobotError(f"the file '{path}' does not exist")
    if path.suffix.lower() == ".json":
        return read_description(path)
    return Description(path.stem, path.stem, str(path.resolve()))


def read_description(path: Path) -> Description:
    """Return the description in a JSON file; raises `RobotError` where a fact is missing or odd."""
    try:
        facts = json.loads(path.read_text())
        if "model" not in facts:
            raise RobotError(f"the description '{path.name}' lacks 'model', the path of its model")
        soles: dict[Foot, SoleFact] = {
            foot: SoleFact(
                sole["body"],
                tuple(sole["size"]) if "size" in sole else None,
                tuple(sole.get("center", (0.0, 0.0, 0.0))),
            )
            for foot, sole in facts.get("soles", {}).items()
        }
        model = str(facts["model"])
        unknown = set(facts) - {"title", "model", "torso", "soles", "posture"}
    except RobotError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise RobotError(f"cannot read the description '{path.name}': {error}") from error
    if unknown:
        raise RobotError(
            f"the description '{path.name}' holds {', '.join(sorted(unknown))}; "
            "expected title, model, torso, soles and posture only"
        )
    if set(soles) not in (set(), set(FEET)):
        raise RobotError(
            f"the description '{path.name}' describes the soles {', '.join(sorted(soles))}; "
            "expected left and right, or neither"
        )
    if not model.startswith(SHIPPED):
        model = str((path.parent / model).resolve())
    return Description(
        path.stem,
        str(facts.get("title", path.stem)),
        model,
        facts.get("torso"),
        soles,
        facts.get("posture", {}),
    )


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
