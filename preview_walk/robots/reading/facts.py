"""What a model file does not say about a robot, as values checked one by one as they are read."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

from preview_walk.errors import RobotError
from preview_walk.geometry.support import Sole
from preview_walk.robots.bounds import LARGEST, LARGEST_GAIN, SMALLEST_EFFORT, SMALLEST_SOLE
from preview_walk.types import FEET, Foot

_PACKAGED = re.compile(r"([A-Za-z0-9][\w.-]+):(.+)")


def in_package(model: str) -> tuple[str, str] | None:
    """Return package and end of path of a model called "PACKAGE:PATH", None for a plain path."""
    named = _PACKAGED.fullmatch(model)
    return None if named is None else (named.group(1), named.group(2))


_FACTS = ("title", "model", "torso", "soles", "posture", "limits")


@dataclass(frozen=True)
class SoleFact:
    """Where a sole is.

    Attributes:
        body: name of the body.
        size: its rectangle; None to find rectangle and centre from the body's shapes.
        center: of the rectangle in the body, m.
        rpy: roll, pitch and yaw of the sole frame in the body, rad; None to find it.
    """

    body: str
    size: Sole | None = None
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rpy: tuple[float, float, float] | None = None


@dataclass(frozen=True)
class MotorLimit:
    """What a motor can do, where its model does not say or says it wrong.

    Attributes:
        torque: largest torque, N·m (N for a slide); None as in the model.
        speed: largest speed, rad/s (m/s for a slide); None as in the model.
    """

    torque: float | None = None
    speed: float | None = None


@dataclass(frozen=True)
class Description:
    """Facts about a robot that its model file does not hold: no gain, weight or timing.

    Attributes:
        name: short name.
        title: name to be read.
        model: a path, or "PACKAGE:PATH" for a file that a package of robots ships.
        torso: the body that is kept upright; None to find it.
        soles: where the soles are; empty to find them.
        posture: joint angles (rad) of the walking posture by name, the legs' left to inverse
            kinematics.
        limits: of motors, by joint name.
    """

    name: str
    title: str
    model: str
    torso: str | None = None
    soles: Mapping[Foot, SoleFact] = field(default_factory=dict)
    posture: Mapping[str, float] = field(default_factory=dict)
    limits: Mapping[str, MotorLimit] = field(default_factory=dict)


@dataclass(frozen=True)
class Facts:
    """The facts in a description file, checked as they are taken."""

    file: str
    facts: Any

    def description(self, path: Path) -> Description:
        """Return the description; `path` is the file, beside which the model is looked for."""
        self._is_object("facts", self.facts, _FACTS)
        if "model" not in self.facts:
            raise RobotError(f"the description '{self.file}' lacks 'model', the path of its model")
        model = self._text("model", self.facts["model"])
        if in_package(model) is None:
            model = str((path.parent / model).resolve())
        return Description(
            path.stem,
            self._text("title", self.facts.get("title", path.stem)),
            model,
            self._text("torso", self.facts["torso"]) if "torso" in self.facts else None,
            self._soles(self.facts.get("soles", {})),
            self._posture(self.facts.get("posture", {})),
            self._limits(self.facts.get("limits", {})),
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
        self._is_object(name, sole, ("body", "size", "center", "rpy"))
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
        rpy = None
        if "rpy" in sole:
            roll, pitch, yaw = self._numbers(f"{name}.rpy", sole["rpy"], 3)
            rpy = (roll, pitch, yaw)
        return SoleFact(self._text(f"{name}.body", sole["body"]), size, (x, y, z), rpy)

    def _limits(self, limits: Any) -> dict[str, MotorLimit]:
        if not isinstance(limits, dict):
            self._refuse("limits", limits, "an object of torque and speed by joint name")
        return {joint: self._limit(f"limits.{joint}", limits[joint]) for joint in limits}

    def _limit(self, name: str, limit: Any) -> MotorLimit:
        self._is_object(name, limit, ("torque", "speed"))
        for key, value in limit.items():
            if not _is_number(value, LARGEST_GAIN) or value < SMALLEST_EFFORT:
                wanted = f"a number from {SMALLEST_EFFORT:g} to {LARGEST_GAIN:g}"
                self._refuse(f"{name}.{key}", value, wanted)
        return MotorLimit(**{key: float(value) for key, value in limit.items()})

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


def _is_number(value: Any, largest: float = LARGEST) -> bool:
    """Return whether a value is a finite number, and not absurdly large."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= largest
