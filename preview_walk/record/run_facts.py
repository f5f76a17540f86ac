"""The facts of a run that are no arrays: robot, rates, limits, pushes, outcome."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from math import nan
from reprlib import repr as short
from typing import Any

from preview_walk.errors import InvalidInput
from preview_walk.record.read_only import ReadOnlyMapping, plain, read_only

CIRCUMSTANCES = frozenset({"wall_time", "command", "versions", "interrupted"})
"""Facts that tell how a run was made, not what was simulated."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RunFacts:
    """What a run was made of and how it ended; nan, "" or None where a fact is not known.

    Attributes:
        robot: name in the catalogue, or of the model file.
        title: what the robot is called in full.
        mass: of the whole robot, kg.
        gravity: m/s².
        joint_names: in the order of `tau`.
        tau_max: limit of each joint's motor, N·m, in the order of `tau`; 0: no motor.
        com_height: of the CoM above the soles in the walking posture, m.
        leg_length: from hip to sole, m.
        step_width: between the soles' centres when the robot stands, m.
        sole: (half length, half width), m.
        omega: natural frequency of the walker's pendulum, 1/s. The record's DCM is
            com_xy + com_velocity_xy / omega, and that of the references is made likewise.
        com_generator: what led the CoM along the plan: "preview", "mpc" or "dcm".
        swing_height: of the swing foot's apex above the ground, m.
        control_hz: ticks of the controller per second.
        record_hz: rows of the record per second; nan: one at every tick.
        physics_hz: steps of the physics per second.
        friction: Coulomb friction between soles and floor.
        ground: what was walked on, as plain values; `Record.ground` makes it one again.
        blind: whether the walker took the ground for level and felt its way.
        realism: what was not perfect about the robot, as plain values; empty: nothing.
        seed: of whatever was random.
        solver: the QP solver's name.
        gains: weights and gains of the tracker by name, as the walk began.
        retuned: one mapping per change of them under way: t (s), gains (all by name).
        pushes: one mapping per push: t (s), duration (s), force ([x, y, z], N, world), body (None:
            the base), point ([x, y, z], m, in the body's axes; None: its centre of mass).
        versions: of Python and of the packages, by name.
        command: the command line of a run by `preview-walk`.
        fell: whether the robot fell.
        fall_time: when, s.
        fall_reason: why, in words.
        interrupted: whether the run was stopped before its end, as by Ctrl-C.
        wall_time: time spent in the loop, s.

    Raises:
        InvalidInput: a fact is not of its type, or `control_hz` is not > 0.
    """

    control_hz: float
    robot: str = ""
    title: str = ""
    mass: float = nan
    gravity: float = nan
    joint_names: tuple[str, ...] = ()
    tau_max: tuple[float, ...] = ()
    com_height: float = nan
    leg_length: float = nan
    step_width: float = nan
    sole: tuple[float, float] = (nan, nan)
    omega: float = nan
    com_generator: str = ""
    swing_height: float = nan
    record_hz: float = nan
    physics_hz: float = nan
    friction: float = nan
    ground: Mapping[str, Any] = ReadOnlyMapping({})
    blind: bool = False
    realism: Mapping[str, Any] = ReadOnlyMapping({})
    seed: int = 0
    solver: str = ""
    gains: Mapping[str, Any] = ReadOnlyMapping({})
    retuned: tuple[Mapping[str, Any], ...] = ()
    pushes: tuple[Mapping[str, Any], ...] = ()
    versions: Mapping[str, Any] = ReadOnlyMapping({})
    command: str = ""
    fell: bool = False
    fall_time: float | None = None
    fall_reason: str | None = None
    interrupted: bool = False
    wall_time: float | None = None

    def __post_init__(self) -> None:
        """Bring every fact to its type, read-only."""
        for each in fields(self):
            name, value = each.name, getattr(self, each.name)
            expected, read = _READERS[str(each.type)]
            try:
                object.__setattr__(self, name, read(value))
            except (TypeError, ValueError, OverflowError, RecursionError):
                raise InvalidInput(
                    f"run fact '{name}' must be {expected}, got {short(value)}.", argument=name
                ) from None
        if not 0.0 < self.control_hz < float("inf"):
            raise InvalidInput(
                f"run fact 'control_hz' must be finite and > 0, got {self.control_hz}.",
                argument="control_hz",
            )

    def __eq__(self, other: object) -> bool:
        # Facts that are not known (nan) are equal.
        return isinstance(other, RunFacts) and self.as_dict() == other.as_dict()

    def __repr__(self) -> str:
        """Return one line: robot, rates and outcome."""
        end = f"fell at {self.fall_time} s" if self.fell else "did not fall"
        return f"RunFacts({self.robot or 'unknown robot'}, {self.control_hz:g} Hz, {end})"

    @property
    def dt(self) -> float:
        """Time between two rows of the record, s: a control period, or that of `record_hz`."""
        return 1.0 / (self.record_hz if self.record_hz > 0.0 else self.control_hz)

    @property
    def weight(self) -> float:
        """Mass times gravity, N."""
        return self.mass * self.gravity

    def as_dict(self) -> dict[str, Any]:
        """Return the facts as plain JSON values by name; None for those that are nan."""
        return {each.name: plain(getattr(self, each.name)) for each in fields(self)}

    @staticmethod
    def from_dict(facts: Mapping[str, Any]) -> RunFacts:
        """Build the facts from those of `as_dict()`; names that are not known are left out."""
        known = {each.name: facts[each.name] for each in fields(RunFacts) if each.name in facts}
        if "control_hz" not in known:
            raise InvalidInput("the facts of a run must hold 'control_hz'.", argument="control_hz")
        return RunFacts(**known)

    def replaced(self, **facts: Any) -> RunFacts:
        """Return the same facts with these replaced.

        Raises:
            InvalidInput: there is no fact of that name, or it is not of its type.
        """
        names = [each.name for each in fields(self)]
        for name in facts:
            if name not in names:
                raise InvalidInput(f"a run fact must be one of {', '.join(names)}, got '{name}'.")
        return replace(self, **facts)

    def differences(self, other: RunFacts) -> tuple[str, ...]:
        """Return the names of the facts that differ, leaving out `CIRCUMSTANCES`."""
        mine, theirs = self.as_dict(), other.as_dict()
        return tuple(n for n in mine if n not in CIRCUMSTANCES and mine[n] != theirs[n])


def _number(value: Any) -> float:
    if isinstance(value, str | bytes):
        raise TypeError
    return nan if value is None else float(value)


def _maybe_number(value: Any) -> float | None:
    return None if value is None else _number(value)


def _text(value: Any) -> str:
    if not isinstance(value, str | None):
        raise TypeError
    return value or ""


def _whole(value: Any) -> int:
    if isinstance(value, str | bytes) or int(value) != value:
        raise TypeError
    return int(value)


def _pair(value: Any) -> tuple[float, float]:
    first, second = value
    return _number(first), _number(second)


def _mapping(value: Any) -> ReadOnlyMapping:
    if not isinstance(value, Mapping):
        raise TypeError
    return ReadOnlyMapping(value)


def _items(value: Any) -> tuple[Any, ...]:
    if isinstance(value, str | Mapping):
        raise TypeError
    return tuple(read_only(list(value)))


_READERS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "float": ("a number", _number),
    "float | None": ("a number or None", _maybe_number),
    "int": ("a whole number", _whole),
    "str": ("text", _text),
    "str | None": ("text or None", lambda value: _text(value) or None),
    "bool": ("true or false", lambda value: bool(_whole(value))),
    "tuple[float, float]": ("two numbers", _pair),
    "tuple[float, ...]": ("numbers", lambda value: tuple(map(_number, _items(value)))),
    "tuple[str, ...]": ("texts", lambda value: tuple(map(_text, _items(value)))),
    "Mapping[str, Any]": ("plain values by name", _mapping),
    "tuple[Mapping[str, Any], ...]": (
        "plain values by name, one mapping each",
        lambda value: tuple(map(_mapping, _items(value))),
    ),
}
"""What each type of fact must be, in words, and how it is read."""
