"""The figures of a run, from its record alone."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from preview_walk.files import whole_file
from preview_walk.geometry.planar import mid_yaw, turn, wrap, yaw
from preview_walk.record.record import Record
from preview_walk.types import FEET, Array

Figures = dict[str, float] | None


@dataclass(frozen=True)
class Summary:
    """What a run came to, SI units; None where a figure has no meaning for the run.

    - `fell`, `fall_time` (s), `fall_reason`; `duration` (s simulated); `steps` that had landed.
    - `distance` (m): the CoM's horizontal path, taken once a stride so that sway does not count.
    - `speed` (m/s): that path over its time, between landings a quarter and three quarters through
      the walk.
    - `final_position_error` (m), `final_yaw_error` (rad): the worse sole at the end of the record,
      against the last poses of the plan; None for a walk that was interrupted.
    - `com_error_rms` [x, y, z], `zmp_error_rms` [x, y] (m): measured minus reference over all
      ticks; x is the planned heading of the moment, so that they do not depend on where the robot
      faces.
    - `torque_ratio_max`: largest share of a motor's limit.
    - `cost_of_transport`: sum of |torque x joint rate| over time, per weight and distance.
    - `tick_ms`, `qp_ms`: median, p99, max; `qp_failures`: ticks that did not use a solved QP.
    - `real_time_factor`: simulated time over time spent.
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
    tick_ms: Figures
    qp_ms: Figures
    qp_failures: int
    real_time_factor: float | None

    def __str__(self) -> str:
        """Return the table that the command prints."""
        from preview_walk.record.summary_table import table

        return table(self)

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write `summary.json`, whole or not at all; return its path.

        Raises:
            OutputError: the file cannot be written.
        """
        text = json.dumps(asdict(self), indent=2, allow_nan=False) + "\n"
        with whole_file(path) as part:
            part.write_text(text, encoding="utf-8")
        return Path(path)


def summarize(record: Record) -> Summary:
    """Compute the figures of a record; `Record.summary()` is the same call."""
    run = record.run
    n = len(record)
    duration = n * record.dt
    path, speed = _path_and_speed(record)
    position_error, yaw_error = _final_errors(record)
    heading = mid_yaw(record.left_foot_ref, record.right_foot_ref)
    com_error = record.com - record.com_ref
    com_error = np.column_stack([turn(com_error[:, :2], -heading), com_error[:, 2]])
    return Summary(
        robot=run.robot or None,
        fell=run.fell,
        fall_time=run.fall_time,
        fall_reason=run.fall_reason,
        duration=duration,
        steps=len(_landed(record)),
        distance=path,
        speed=speed,
        final_position_error=position_error,
        final_yaw_error=yaw_error,
        com_error_rms=_rms(com_error),
        zmp_error_rms=_rms(turn(record.zmp - record.zmp_ref, -heading)),
        torque_ratio_max=_torque_ratio_max(record),
        cost_of_transport=_cost_of_transport(record, path),
        tick_ms=_times_ms(record.tick_time),
        qp_ms=_times_ms(record.qp_time),
        qp_failures=int(np.count_nonzero(record.qp_status > 0)),
        real_time_factor=_number(duration / run.wall_time) if run.wall_time else None,
    )


def torque_ratios(record: Record) -> Array:
    """Return |tau| / tau_max (N, nu), nan for joints without a motor or without a limit."""
    limits = np.array(record.run.tau_max, dtype=np.float64)
    if limits.shape != record.tau.shape[1:]:
        return np.full(record.tau.shape, np.nan)
    limits = np.where((limits > 0) & np.isfinite(limits), limits, np.nan)
    ratios: Array = np.abs(record.tau) / limits
    return ratios


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _rms(error: Array) -> list[float | None]:
    """Root mean square of each column over its finite rows."""
    columns = [column[np.isfinite(column)] for column in error.T]
    return [float(np.sqrt(np.mean(c**2))) if len(c) else None for c in columns]


def _times_ms(seconds: Array) -> Figures:
    times = 1e3 * seconds[np.isfinite(seconds)]
    if not len(times):
        return None
    median, p99 = np.percentile(times, [50, 99])
    return {"median": float(median), "p99": float(p99), "max": float(times.max())}


def _end(record: Record) -> float:
    """Return the time (s) up to which the robot walked: the fall, or the end of the record."""
    fall_time = record.run.fall_time
    end = float(record.time[-1])
    return end if fall_time is None else min(end, fall_time)


def _landed(record: Record) -> Array:
    """Return the planned landing times (s) of the steps taken."""
    if not len(record) or not len(record.plans):
        return np.zeros(0)
    return record.plans.walked(_end(record)).landings


def _path_and_speed(record: Record) -> tuple[float, float | None]:
    """Return the CoM's path in m, sampled once a stride, and its steady speed in m/s."""
    if not len(record):
        return 0.0, None
    landed = _landed(record)
    # Every second landing is of the same foot: the sway is at the same point of its cycle. The last
    # landing is left out, for what follows it is sway alone.
    times = np.concatenate([[record.time[0]], landed[1:-1:2], [_end(record)]])
    distance = _path(record, times)
    if len(landed) < 3:
        return distance, None
    first, last = round(0.25 * (len(landed) - 1)), round(0.75 * (len(landed) - 1))
    strides = max(1, (last - first) // 2)
    span = landed[first : first + 2 * strides + 1 : 2]
    return distance, _path(record, span) / float(span[-1] - span[0])


def _path(record: Record, times: Array) -> float:
    points = np.column_stack([np.interp(times, record.time, record.com[:, k]) for k in (0, 1)])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _final_errors(record: Record) -> tuple[float | None, float | None]:
    if not len(record) or not len(record.plans):
        return None, None
    if record.run.interrupted and record.time[-1] < record.plans[-1].end:
        return None, None
    position, angle = [], []
    for foot in FEET:
        pose = (record.left_foot if foot == "left" else record.right_foot)[-1]
        planned = record.plans[-1].last_pose(foot)
        position.append(float(np.linalg.norm(pose[:3, 3] - planned[:3, 3])))
        angle.append(abs(float(wrap(yaw(pose) - yaw(planned)))))
    return _number(max(position)), _number(max(angle))


def _torque_ratio_max(record: Record) -> float | None:
    ratios = torque_ratios(record)
    return float(np.nanmax(ratios)) if np.isfinite(ratios).any() else None


def _cost_of_transport(record: Record, distance: float) -> float | None:
    """Mechanical cost of transport, counting braking as work; None below 0.1 m of walking."""
    rates = record.v[:, 6 : 6 + record.tau.shape[1]]
    work = float(np.nansum(np.abs(record.tau * rates))) * record.dt
    return _number(work / (record.run.weight * distance)) if distance >= 0.1 else None
