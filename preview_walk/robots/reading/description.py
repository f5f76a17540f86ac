"""The catalogue: one small JSON file per robot in `models/`, and files like these of one's own."""

from __future__ import annotations

import json
from difflib import get_close_matches
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path

from preview_walk.errors import RobotError
from preview_walk.robots.reading.content import is_there, shown
from preview_walk.robots.reading.facts import Description, Facts, in_package

DEFAULT_PACKAGE = "example-robot-data"
"""The package of robots that is always installed."""


def models_folder() -> Path:
    """Return the folder of descriptions: inside the wheel, or beside the package in a checkout."""
    inside = Path(str(files("preview_walk"))) / "models"
    return inside if inside.is_dir() else inside.parent.parent / "models"


def catalogue() -> tuple[str, ...]:
    """Return the names of the robots that `load_robot` knows, sorted.

    Those of the extra "robots" are among them where their packages are installed.
    """
    return tuple(sorted(path.stem for path in models_folder().glob("*.json") if _installed(path)))


def _installed(path: Path) -> bool:
    """Return whether the package of robots that a description names, if any, is installed."""
    packaged = in_package(str(json.loads(path.read_text(encoding="utf-8"))["model"]))
    if packaged is None or packaged[0] == DEFAULT_PACKAGE:
        return True
    try:
        distribution(packaged[0])
    except PackageNotFoundError:
        return False
    return True


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
    if is_there(models_folder() / f"{name.lower()}.json"):
        return name.lower()
    known = catalogue()
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
    return Facts(path.name, facts).description(path)


def model_path(model: str) -> Path:
    """Return the file that a description's `model` names.

    Raises:
        RobotError: a package of robots that is not installed, or that lacks the file.
    """
    packaged = in_package(model)
    if packaged is None:
        return Path(model)
    package, end = packaged
    if package == DEFAULT_PACKAGE:
        return example_robot_data() / end
    for file in _package(package).files or ():
        if f"/{file.as_posix()}".endswith(f"/{end}"):
            return Path(str(file.locate())).resolve()
    raise RobotError(f"the package '{package}' has no file that ends in '{end}'")


def _package(name: str) -> Distribution:
    """Return an installed package of robots."""
    try:
        return distribution(name)
    except (PackageNotFoundError, ValueError) as missing:
        raise RobotError(
            f"the package '{name}' is not installed; expected it for a robot of the catalogue: "
            "pip install 'preview-walk[robots]'"
        ) from missing


def example_robot_data() -> Path:
    """Return the folder of robots that the package example-robot-data ships (data only)."""
    return Path(
        str(_package(DEFAULT_PACKAGE).locate_file("cmeel.prefix/share/example-robot-data/robots"))
    )
