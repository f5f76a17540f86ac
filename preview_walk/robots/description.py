"""What a model file does not say about a robot: one small JSON file per robot in `models/`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from preview_walk.errors import RobotError
from preview_walk.types import Foot


@dataclass(frozen=True)
class SoleFact:
    """Where a sole is: body or frame name, size (length, width) in m, its centre in the body."""

    body: str
    size: tuple[float, float]
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Description:
    """Facts about a robot: no gain, weight or timing belongs here.

    `model` is a path, or "example-robot-data:PATH" for a file that package ships; `posture` holds
    the walking posture's joint angles (rad) that are not zero, legs left to inverse kinematics.
    """

    name: str
    title: str
    model: str
    torso: str
    soles: Mapping[Foot, SoleFact]
    posture: Mapping[str, float] = field(default_factory=dict)


def models_folder() -> Path:
    """Return the folder of descriptions: inside the wheel, or beside the package in a checkout."""
    inside = Path(str(files("preview_walk"))) / "models"
    return inside if inside.is_dir() else inside.parent.parent / "models"


def catalogue() -> tuple[str, ...]:
    """Return the names of the robots that `load_robot` knows, sorted."""
    return tuple(sorted(path.stem for path in models_folder().glob("*.json")))


def read_description(name: str) -> Description:
    """Return the description of a robot of the catalogue; raises `RobotError` for another name."""
    path = models_folder() / f"{name}.json"
    if name not in catalogue():
        raise RobotError(
            f"unknown robot '{name}'; expected one of {', '.join(catalogue())}, "
            "or the path of a .urdf or .xml file"
        )
    facts = json.loads(path.read_text())
    soles: dict[Foot, SoleFact] = {
        foot: SoleFact(
            sole["body"], tuple(sole["size"]), tuple(sole.get("center", (0.0, 0.0, 0.0)))
        )
        for foot, sole in facts["soles"].items()
    }
    return Description(
        name, facts["title"], facts["model"], facts["torso"], soles, facts.get("posture", {})
    )


def model_path(model: str) -> Path:
    """Return the file that a description's `model` names."""
    if model.startswith("example-robot-data:"):
        return example_robot_data() / model.removeprefix("example-robot-data:")
    path = Path(model)
    return path if path.is_absolute() else models_folder() / path


def example_robot_data() -> Path:
    """Return the folder of robots that the package example-robot-data ships (data only)."""
    from importlib.metadata import PackageNotFoundError, distribution

    try:
        package = distribution("example-robot-data")
    except PackageNotFoundError as missing:
        raise RobotError(
            "example-robot-data is not installed; expected it for the robots of the catalogue"
        ) from missing
    return Path(
        str(package.locate_file("cmeel.prefix/share/example-robot-data/robots"))
    )
