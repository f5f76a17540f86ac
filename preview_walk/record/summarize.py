"""The figures of a run computed from its ticks, plans and facts."""

from __future__ import annotations

import numpy as np

from preview_walk.geometry.planar import mid_yaw, turn, wrap, yaw
from preview_walk.record.fields import Ticks
from preview_walk.record.plan_log import PlanLog
from preview_walk.record.run_facts import RunFacts
from preview_walk.record.sensed import Sensed
from preview_walk.record.summary import Figures, Summary
from preview_walk.types import FEET, Array


@np.errstate(invalid="ignore", over="ignore", divide="ignore")
def summarize(ticks: Ticks, plans: PlanLog, run: RunFacts, sensed: Sensed | None = None) -> Summary:
    """Compute the figures of a run; `Record.summary()` is the same call.

    Args:
        ticks: planned and measured values; a record is one.
        plans: the footstep plans that were in force.
        run: what the run was made of.
        sensed: what a robot with real sensors sensed; its CoM error is the true one.
    """
    duration = len(ticks.time) * run.dt
    landed = _landed(ticks, plans, run)
    path, speed = _path_and_speed(ticks, landed, _end(ticks, run))
    absolute, positive = _work(ticks, run)
    position_error, yaw_error = _final_errors(ticks, plans, run)
    heading = mid_yaw(ticks.left_foot_ref, ticks.right_foot_ref)
    com_error = ticks.com - ticks.com_ref
    if sensed is not None:
        com_error = sensed.com_error(ticks.q, ticks.com_ref)
    com_error = np.column_stack([turn(com_error[:, :2], -heading), com_error[:, 2]])
    return Summary(
        robot=run.robot or None,
        fell=run.fell,
        fall_time=run.fall_time,
        fall_reason=run.fall_reason,
        duration=duration,
        steps=len(landed),
        distance=path,
        speed=speed,
        final_position_error=position_error,
        final_yaw_error=yaw_error,
        com_error_rms=_rms(com_error),
        zmp_error_rms=_rms(turn(ticks.zmp - ticks.zmp_ref, -heading)),
        torque_ratio_max=_torque_ratio_max(ticks, run),
        cost_of_transport=_cost_of_transport(absolute, run, path),
        cost_of_transport_positive=_cost_of_transport(positive, run, path),
        tick_ms=_times_ms(ticks.tick_time),
        qp_ms=_times_ms(ticks.qp_time),
        qp_failures=int(np.count_nonzero(ticks.qp_status > 0)),
        qp_own_share=_own_share(ticks),
        real_time_factor=_number(duration / run.wall_time) if run.wall_time else None,
        velocity_error_rms=None if sensed is None else _rms(sensed.velocity_error(ticks.v)),
        drift=_drift(ticks, sensed, path),
        refused=None if sensed is None or not len(ticks.time) else int(sensed.refused[-1]),
    )


def _drift(ticks: Ticks, sensed: Sensed | None, path: float) -> float | None:
    """Return by which share of the way the base is elsewhere than estimated in the end."""
    if sensed is None or path < 0.1:
        return None
    error = ticks.q[-1, :2] - sensed.estimate_q[-1, :2]
    return _number(float(np.linalg.norm(error)) / path)


def torque_ratios(ticks: Ticks, run: RunFacts) -> Array:
    """Return |tau| / tau_max (N, nu), nan for joints without a motor or without a limit."""
    limits = np.array(run.tau_max, dtype=np.float64)
    if limits.shape != ticks.tau.shape[1:]:
        return np.full(ticks.tau.shape, np.nan)
    limits = np.where((limits > 0) & np.isfinite(limits), limits, np.nan)
    ratios: Array = np.abs(ticks.tau) / limits
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


def _own_share(ticks: Ticks) -> float | None:
    """Return the share of the solved QPs that the exact method did not have to finish."""
    by = ticks.qp_solver[(ticks.qp_status == 0) & (ticks.qp_solver >= 0)]
    return float(np.mean(by == 0)) if len(by) else None


def _end(ticks: Ticks, run: RunFacts) -> float:
    """Return the time (s) up to which the robot walked: the fall, or the end of the ticks."""
    ends = [float(time) for time in (*ticks.time[-1:], run.fall_time) if time is not None]
    return min(ends, default=0.0)


def _landed(ticks: Ticks, plans: PlanLog, run: RunFacts) -> Array:
    """Return the planned landing times (s) of the steps taken."""
    if not len(ticks.time) or not len(plans):
        return np.zeros(0)
    return plans.walked(_end(ticks, run)).landings


def _path_and_speed(ticks: Ticks, landed: Array, end: float) -> tuple[float, float | None]:
    """Return the CoM's path in m, sampled once a stride, and its steady speed in m/s."""
    if not len(ticks.time):
        return 0.0, None
    # Every second landing is of the same foot: the sway is at the same point of its cycle. The last
    # landing is left out, for what follows it is sway alone.
    times = np.concatenate([[ticks.time[0]], landed[1:-1:2], [end]])
    distance = _path(ticks, times)
    if len(landed) < 3:
        return distance, None
    first, last = round(0.25 * (len(landed) - 1)), round(0.75 * (len(landed) - 1))
    strides = max(1, (last - first) // 2)
    span = landed[first : first + 2 * strides + 1 : 2]
    return distance, _path(ticks, span) / float(span[-1] - span[0])


def _path(ticks: Ticks, times: Array) -> float:
    points = np.column_stack([np.interp(times, ticks.time, ticks.com[:, k]) for k in (0, 1)])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _final_errors(ticks: Ticks, plans: PlanLog, run: RunFacts) -> tuple[float | None, float | None]:
    """Return the worse sole's position (m) and yaw (rad) errors against the last plan."""
    if not len(ticks.time) or not len(plans):
        return None, None
    last = plans[-1]
    if run.interrupted and ticks.time[-1] < last.end:
        return None, None
    position, angle = [], []
    for foot in FEET:
        pose = (ticks.left_foot if foot == "left" else ticks.right_foot)[-1]
        planned = last.last_pose(foot)
        position.append(float(np.linalg.norm(pose[:3, 3] - planned[:3, 3])))
        angle.append(abs(float(wrap(yaw(pose) - yaw(planned)))))
    return _number(max(position)), _number(max(angle))


def _torque_ratio_max(ticks: Ticks, run: RunFacts) -> float | None:
    ratios = torque_ratios(ticks, run)
    return float(np.nanmax(ratios)) if np.isfinite(ratios).any() else None


def _work(ticks: Ticks, run: RunFacts) -> tuple[float, float]:
    """Return the absolute and the positive mechanical work (J) of all joints."""
    power = ticks.tau * ticks.v[:, 6 : 6 + ticks.tau.shape[1]]
    absolute, positive = np.nansum(np.abs(power)), np.nansum(np.maximum(power, 0.0))
    return float(absolute) * run.dt, float(positive) * run.dt


def _cost_of_transport(work: float, run: RunFacts, distance: float) -> float | None:
    """Return work (J) per weight and distance (m); None below 0.1 m of walking."""
    return _number(work / (run.weight * distance)) if distance >= 0.1 else None
