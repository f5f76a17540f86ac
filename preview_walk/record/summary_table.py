"""The summary as the plain text table that the command prints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from preview_walk.record.summary import Figures, Summary


def table(summary: Summary) -> str:
    """Return one aligned line per figure: name, value, unit."""
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
        ("tick median, p99, max", _times(s.tick_ms)),
        ("QP median, p99, max", _times(s.qp_ms)),
        ("QP failures", str(s.qp_failures)),
        ("real-time factor", _value(s.real_time_factor, 2, "x")),
    ]
    width = max(len(name) for name, _ in rows)
    return "\n".join(f"{name:{width}}  {value}" for name, value in rows)


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
