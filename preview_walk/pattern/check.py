"""One call that says in words what is wrong with a plan and its references, and where.

`check_plan` looks at every step (reach, time in the air, soles that collide, motors) and at the
references (ZMP outside the support polygon, CoM that runs away from the feet, jumps).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import instance_of, real_array
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.findings import Finding, motor_findings, step_findings
from preview_walk.footsteps.laying import ground_findings
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.terrain.ground import Ground
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, Array

OUTSIDE = 1e-6
"""The ZMP may be this far (m) outside the support polygon: rounding."""

DIVERGED = 0.1
"""A CoM this far (m) outside the hull of the soles and the next landing has run away."""

JUMP = 0.005
"""A ZMP that moves further (m) in one sample, and three times as far as just before and after,
jumps."""

COM_ACCELERATION = 30.0
"""A CoM reference with a larger acceleration (m/s^2) jumps: three times gravity."""

_SAMPLES = 12
"""The plan's own ZMP reference is looked at in this many places of every support phase."""

_PHASES = {DOUBLE_SUPPORT: "double support", LEFT_SUPPORT: "left support"}
"""Names of the support phases but the last."""


def check_plan(
    plan: PlanLike,
    limits: GaitLimits,
    times: ArrayLike | None = None,
    zmp: ArrayLike | None = None,
    com: ArrayLike | None = None,
    *,
    ground: Ground | None = None,
) -> tuple[Finding, ...]:
    """Return what is wrong with a plan and its references, in the order of time; () if nothing.

    Args:
        plan: the walk; whatever `as_plan` takes.
        limits: bounds of its steps, and the sole sizes.
        times: increasing times (N,) of the references below, s.
        zmp: ZMP reference (N, 2), m; None checks the plan's own.
        com: CoM reference (N, 2) or (N, 3), m; None checks none.
        ground: on which the soles are to lie; None does not look at their heights and tilts.

    Raises:
        InvalidInput: no plan, a reference without times, or arrays that do not fit each other.
    """
    plan, limits = as_plan(plan), instance_of(limits, GaitLimits, "limits")
    findings = [*step_findings(plan, limits)]
    # A step out of the legs' reach has no motion whose torques could be told.
    findings += motor_findings(plan, limits) if not findings else []
    if ground is not None:
        findings += ground_findings(plan, ground, limits.sole)
    if times is None:
        if zmp is not None or com is not None:
            raise InvalidInput(
                "times (N,) must be given with zmp or com, got None.", argument="times"
            )
        t = np.concatenate([np.linspace(a, b, _SAMPLES + 1)[:-1] for a, b in _intervals(plan)])
        findings += _outside(plan, limits, t, zmp_reference(plan, limits.sole).at(t))
    else:
        t = _array(times, "times", 0, ())
        if not (np.isfinite(t).all() and (np.diff(t) > 0.0).all()):
            raise InvalidInput("times must be finite and increase.", argument="times")
        if zmp is None:
            findings += _outside(plan, limits, t, zmp_reference(plan, limits.sole).at(t))
        else:
            path = _array(zmp, "zmp", len(t), (2,))
            finite = _finite(path)
            findings += _endless("ZMP", t, finite)
            findings += _outside(plan, limits, t[:finite], path[:finite], "zmp")
            findings += _zmp_jumps(t[:finite], path[:finite])
        if com is not None:
            path = _array(com, "com", len(t), (2, 3))
            finite = _finite(path)
            findings += _endless("CoM", t, finite)
            findings += _diverges(plan, limits, t[:finite], path[:finite, :2])
            findings += _com_jumps(t[:finite], path[:finite])
    return tuple(sorted(findings, key=lambda finding: finding.time))


def require_walkable(plan: PlanLike, limits: GaitLimits) -> None:
    """Do nothing if `check_plan` finds nothing.

    Args:
        plan: the walk.
        limits: bounds of its steps, and the sole sizes.

    Raises:
        InvalidInput: with the first thing that is wrong with the plan; `argument` is that of a
            planner, as in `Finding`.
    """
    findings = check_plan(plan, limits)
    if findings:
        more = f" ({len(findings) - 1} more)" if len(findings) > 1 else ""
        raise InvalidInput(
            f"the plan cannot be walked: {findings[0]}{more}.", argument=findings[0].argument
        )


def _intervals(plan: FootstepPlan) -> Iterator[tuple[float, float]]:
    """Return the beginnings and ends of the support phases."""
    edges = [plan.start, *(t for s in plan.steps for t in (s.lift, s.land)), plan.end + 1.0]
    return pairwise(edges)


def _spans(plan: FootstepPlan, t: Array) -> Iterator[tuple[int, int]]:
    """Return the ranges of samples within one support phase each."""
    edges = [end for _, end in _intervals(plan)][:-1]
    cuts = [0, *np.searchsorted(t, edges, side="left").tolist(), len(t)]
    return ((a, b) for a, b in pairwise(cuts) if b > a)


def _outside(
    plan: FootstepPlan, limits: GaitLimits, t: Array, zmp: Array, argument: str = "plan"
) -> Iterator[Finding]:
    """Yield where the ZMP is furthest outside the support, in every phase in which it is."""
    for a, b in _spans(plan, t):
        phase = plan.support(float(t[a]))
        swing = plan.swing_at(float(t[a]))
        feet = [foot for foot in FEET if swing is None or swing.foot != foot]
        soles = [plan.sole(foot, float(t[a])) for foot in feet]
        margin = support_margin(support_polygon(soles, limits.sole), zmp[a:b])
        worst = int(margin.argmin())
        if margin[worst] < -OUTSIDE:
            name = _PHASES.get(phase, "right support")
            text = f"the ZMP is {-margin[worst]:.3f} m outside the support polygon ({name})"
            yield Finding(float(t[a + worst]), text, argument=argument)


def _diverges(plan: FootstepPlan, limits: GaitLimits, t: Array, com: Array) -> Iterator[Finding]:
    """Yield where the CoM first is too far outside the feet."""
    for a, b in _spans(plan, t):
        now = float(t[a])
        soles = [plan.sole(foot, now) for foot in FEET]
        landing = plan.next_landing(now)
        soles += [landing.pose] if landing is not None else []
        margin = support_margin(support_polygon(soles, limits.sole), com[a:b])
        far = np.flatnonzero(margin < -DIVERGED)
        if far.size:
            text = f"the CoM diverges: it is {-margin[far[0]]:.3f} m outside the feet"
            yield Finding(float(t[a + far[0]]), text, argument="com")
            return


def _zmp_jumps(t: Array, zmp: Array) -> Iterator[Finding]:
    """Yield where the ZMP jumps."""
    move = np.linalg.norm(np.diff(zmp, axis=0), axis=1)
    beside = np.maximum(np.append(0.0, move)[:-1], np.append(move, 0.0)[1:])
    for k in np.flatnonzero((move > JUMP) & (move > 3.0 * beside)):
        text = f"the ZMP jumps by {move[k]:.3f} m in {t[k + 1] - t[k]:.4f} s"
        yield Finding(float(t[k]), text, argument="zmp")


def _com_jumps(t: Array, com: Array) -> Iterator[Finding]:
    """Yield where the CoM or its velocity jumps."""
    if len(t) < 3:
        return
    step = np.diff(t)[:, None]
    speed = np.diff(com, axis=0) / step
    bend = np.linalg.norm(np.diff(speed, axis=0), axis=1) / (0.5 * (step[1:] + step[:-1])[:, 0])
    jumps = np.flatnonzero(bend > COM_ACCELERATION)
    # A jump bends the path before and after it: one finding for the run of them.
    for k in jumps[np.diff(jumps, prepend=-9) > 2]:
        text = f"the CoM jumps: its acceleration is {bend[k]:.1f} m/s^2"
        yield Finding(float(t[k + 1]), text, argument="com")


def _array(value: ArrayLike, name: str, rows: int, columns: tuple[int, ...]) -> Array:
    """Return an array of this many rows and columns, or a vector where there are no columns."""
    form = " or ".join(f"({rows}, {c})" for c in columns) if columns else "(N,)"
    array = real_array(value, name, f"an array of shape {form}")
    good = array.ndim == 1 and len(array) > 0
    if columns:
        good = array.ndim == 2 and len(array) == rows and array.shape[1] in columns
    if not good:
        raise InvalidInput(f"{name} must have shape {form}, got {array.shape}.", argument=name)
    return array


def _finite(path: Array) -> int:
    """Return the number of samples before the first that is not finite."""
    bad = np.flatnonzero(~np.isfinite(path).all(axis=1))
    return int(bad[0]) if bad.size else len(path)


def _endless(name: str, t: Array, finite: int) -> list[Finding]:
    """Return the finding that a reference has only so many finite samples, if that is so."""
    if finite == len(t):
        return []
    text = f"the {name} is not finite"
    return [Finding(float(t[finite]), text, argument=name.lower())]
