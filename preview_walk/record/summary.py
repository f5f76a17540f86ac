"""The figures of a run as a value: a table to print, a file to write."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from preview_walk.files import whole_file
from preview_walk.html import html_table

Figures = dict[str, float] | None

_SENSED = ("velocity_error_rms", "drift", "refused")


@dataclass(frozen=True)
class Summary:
    """What a run came to, SI units; None where a figure has no meaning for the run.

    Attributes:
        robot: name of the robot.
        fell: whether it fell.
        fall_time: when, s.
        fall_reason: why, in words.
        duration: seconds simulated.
        steps: how many had landed.
        distance: the CoM's horizontal path, m, taken once a stride so that sway does not count.
        speed: that path over its time, m/s, between the landings a quarter and three quarters
            through the walk.
        final_position_error: of the worse sole at the end of the record, m, against the last poses
            of the plan; None for a walk that was interrupted.
        final_yaw_error: the same, rad.
        com_error_rms: [x, y, z], m, measured minus reference over all ticks; x is the planned
            heading of the moment, so that it does not depend on where the robot faces.
        zmp_error_rms: [x, y], m, likewise.
        torque_ratio_max: largest share of a motor's limit.
        cost_of_transport: absolute mechanical work, the sum over time of the size of
            torque times joint rate, per weight and distance: braking costs as much as driving.
        cost_of_transport_positive: the same of positive work alone: braking is free.
        tick_ms: median, p99 and max of the control tick's wall time, ms.
        qp_ms: the same of its QP.
        qp_failures: ticks that did not use a solved QP.
        qp_own_share: share of the solved QPs that the run's solver solved itself; the exact method
            finished the others.
        real_time_factor: simulated time over time spent.
        velocity_error_rms: [x, y, z] of the estimated velocity of the base, base axes, m/s; this
            and what follows None where the sensors are perfect.
        drift: how far the base is from where it is estimated in the end, share of the distance.
        refused: readings of sensors that could not be, and were not taken.
    """

    robot: str | None
    fell: bool
    fall_time: float | None
    fall_reason: str | None
    duration: float
    steps: int
    distance: float
    speed: float | None
    final_position_error: float | None
    final_yaw_error: float | None
    com_error_rms: list[float | None]
    zmp_error_rms: list[float | None]
    torque_ratio_max: float | None
    cost_of_transport: float | None
    cost_of_transport_positive: float | None
    tick_ms: Figures
    qp_ms: Figures
    qp_failures: int
    qp_own_share: float | None
    real_time_factor: float | None
    velocity_error_rms: list[float | None] | None = None
    drift: float | None = None
    refused: int | None = None

    def __str__(self) -> str:
        """Return the table that the command prints."""
        return table(self)

    def __repr__(self) -> str:
        """Return one line: robot, seconds, steps and outcome."""
        robot = self.robot or "unknown robot"
        return f"Summary({robot}, {self.duration:.3f} s, {self.steps} steps, {_outcome(self)})"

    def _repr_html_(self) -> str:
        """Return the table as a notebook shows it."""
        return html_table(repr(self), rows_of(self))

    def as_json(self) -> dict[str, Any]:
        """Return the figures as JSON has them: None where not finite, sensors' if there are any."""
        figures = {
            name: value
            for name, value in asdict(self).items()
            if name not in _SENSED or self.velocity_error_rms is not None
        }
        finite: dict[str, Any] = _finite(figures)
        return finite

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write `summary.json`, whole or not at all; return its path.

        What is not finite is written as null, for JSON has no infinite numbers; figures of sensors
        are left out where these are perfect.

        Raises:
            OutputError: the file cannot be written.
        """
        text = json.dumps(self.as_json(), indent=2, allow_nan=False) + "\n"
        with whole_file(path) as part:
            part.write_text(text, encoding="utf-8")
        return Path(path)


def _finite(value: Any) -> Any:
    """Return plain values with None for every number that is not finite."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value


def table(summary: Summary) -> str:
    """Return one aligned line per figure: name, value, unit."""
    rows = rows_of(summary)
    width = max(len(name) for name, _ in rows)
    return "\n".join(f"{name:{width}}  {value}" for name, value in rows)


def rows_of(summary: Summary) -> list[tuple[str, str]]:
    """Return the figures as they are shown: name, value with its unit."""
    s = summary
    rows = [
        ("robot", s.robot or "unknown"),
        ("outcome", _outcome(s)),
        ("duration", _value(s.duration, 2, "s simulated")),
        ("steps landed", str(s.steps)),
        ("distance", _value(s.distance, 3, "m")),
        ("speed (steady part)", _value(s.speed, 3, "m/s")),
        ("final position error", _value(s.final_position_error, 1, "mm", 1e3)),
        ("final yaw error", _value(s.final_yaw_error, 2, "deg", 180 / np.pi)),
        ("CoM error rms x, y, z", _values(s.com_error_rms, 2, "mm", 1e3)),
        ("ZMP error rms x, y", _values(s.zmp_error_rms, 2, "mm", 1e3)),
        ("largest torque / limit", _value(s.torque_ratio_max, 3, "")),
        ("cost of transport", _value(s.cost_of_transport, 3, "")),
        ("  positive work alone", _value(s.cost_of_transport_positive, 3, "")),
        ("tick median, p99, max", _times(s.tick_ms)),
        ("QP median, p99, max", _times(s.qp_ms)),
        ("QP failures", str(s.qp_failures)),
        ("QPs the solver solved", _value(s.qp_own_share, 2, "%", 1e2)),
        ("real-time factor", _value(s.real_time_factor, 2, "x")),
    ]
    if s.velocity_error_rms is not None:
        rows += [
            ("base velocity off rms", _values(s.velocity_error_rms, 1, "mm/s", 1e3)),
            ("position drift", _value(s.drift, 2, "% of the way", 1e2)),
            ("readings refused", str(s.refused)),
        ]
    return rows


def _outcome(s: Summary) -> str:
    if not s.fell:
        return "did not fall"
    when = f" at {s.fall_time:.2f} s" if s.fall_time is not None else ""
    return f"FELL{when}" + (f": {s.fall_reason}" if s.fall_reason else "")


def _value(value: float | None, digits: int, unit: str, scale: float = 1.0) -> str:
    return "-" if value is None else f"{scale * value:.{digits}f} {unit}".rstrip()


def _values(values: Sequence[float | None], digits: int, unit: str, scale: float) -> str:
    parts = ["-" if v is None else f"{scale * v:.{digits}f}" for v in values]
    return f"{', '.join(parts)} {unit}"


def _times(figures: Figures) -> str:
    return "-" if figures is None else f"{', '.join(f'{v:.3f}' for v in figures.values())} ms"
