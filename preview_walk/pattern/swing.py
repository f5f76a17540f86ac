"""The swing foot: piecewise quintics from lift to landing, at rest at both ends.

x, y and the Z-Y-X angles follow one quintic each; the height follows two, over an apex halfway.
Derivatives up to the acceleration are continuous, also through `Swing.retarget`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import cos, hypot, sin

import numpy as np

from preview_walk.arguments import SMALLEST, finite_number, instance_of, number_from_zero, time_of
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.swing_shape import PLAIN, SwingShape
from preview_walk.geometry.planar import wrap
from preview_walk.geometry.poses import as_pose, pose_at, rpy_of
from preview_walk.geometry.quintic import Quintic, State
from preview_walk.types import Array

RISEN_SHARE = 0.48
"""Share of its rise that the sole has made when a tenth of the horizontal travel is done."""

GROUND_CLEARANCE = 0.02
"""Default height (m) of a swinging sole above the line between its ends, but near those."""

DIP = 1e-3
"""A retargeted foot may come this much (m) below its landing before it lands."""


@dataclass(frozen=True, eq=False)
class Swing:
    """The path of one sole from lift to landing, as a value.

    Attributes:
        start: sole pose at lift, (4, 4).
        end: sole pose at landing, (4, 4).
        lift: time (s) at which the sole leaves the ground.
        land: time (s) at which it is down.
        swing_height: height (m) of the apex above the higher of the two soles.
        ground_clearance: height (m) of the sole centre above the straight line from one sole
            centre to the other, at least, between 10 % and 90 % of its horizontal travel; the
            apex is raised where `swing_height` alone does not.
        shape: when it rises, travels and comes down, and how high it goes at least.
        plane: the quintics of x, y, yaw, pitch and roll; left out when a swing is made.
        vertical: those of the height, one after the other; left out when a swing is made.

    Raises:
        InvalidInput: a pose that is none, times out of order, or a negative height.
    """

    start: Array
    end: Array
    lift: float
    land: float
    swing_height: float = 0.05
    ground_clearance: float = GROUND_CLEARANCE
    shape: SwingShape = PLAIN
    plane: tuple[Quintic, ...] = field(default=(), repr=False, kw_only=True)
    vertical: tuple[Quintic, ...] = field(default=(), repr=False, kw_only=True)

    def __post_init__(self) -> None:
        """Check the fields; make the polynomials."""
        if self.plane:
            return
        object.__setattr__(self, "start", as_pose(self.start, "start"))
        object.__setattr__(self, "end", as_pose(self.end, "end"))
        for name in ("lift", "land"):
            object.__setattr__(self, name, finite_number(getattr(self, name), name, "s"))
        if not self.land - self.lift >= SMALLEST:
            times = f"{self.lift} s, {self.land} s"
            raise InvalidInput(f"a swing needs lift < land, got {times}.", argument="land")
        for name in ("swing_height", "ground_clearance"):
            object.__setattr__(self, name, number_from_zero(getattr(self, name), name, "m"))
        instance_of(self.shape, SwingShape, "shape")
        first, last = _coordinates(self.start), _coordinates(self.end)
        go, arrive = self.shape.way(self.lift, self.land)
        plane = tuple(
            Quintic.between(go, arrive, (p, 0.0, 0.0), (q, 0.0, 0.0))
            for p, q in zip(first, _near(last, first), strict=True)
        )
        z0, z1 = float(self.start[2, 3]), float(self.end[2, 3])
        middle = self.shape.top(self.lift, self.land)
        vertical = _over((self.lift, (z0, 0.0, 0.0)), (middle, self._apex(z0, z1)), (self.land, z1))
        object.__setattr__(self, "plane", plane)
        object.__setattr__(self, "vertical", vertical)

    def _apex(self, z0: float, z1: float) -> float:
        """Return the height (m) of the apex over soles at these two heights (m)."""
        return apex_height(z0, z1, self.shape, self.swing_height, self.ground_clearance)

    def at(self, t: float) -> tuple[Array, Array, Array]:
        """Return pose (4, 4), velocity (6,) and acceleration (6,) of the sole at time t (s).

        Velocity and acceleration are [linear; angular], in the world, of the sole frame's origin.
        Before lift the sole is at `start`, after landing at `end`, at rest.

        Raises:
            InvalidInput: t is not a number.
        """
        if type(t) is not float or t != t:
            t = time_of(t)
        (x, vx, ax), (y, vy, ay), (w, vw, aw), (p, vp, ap), (r, vr, ar) = [
            q.at(t) for q in self.plane
        ]
        z, vz, az = self._height(t).at(t)
        pose = pose_at(x, y, w, z, p, r)
        cw, sw, cp, sp = cos(w), sin(w), cos(p), sin(p)
        # Angular velocity of Rz(w) Ry(p) Rx(r), and its derivative, in the world.
        velocity = np.array(
            [vx, vy, vz, cw * cp * vr - sw * vp, sw * cp * vr + cw * vp, vw - sp * vr]
        )
        acceleration = np.array(
            [
                ax,
                ay,
                az,
                cw * cp * ar - sw * ap - cw * vw * vp - (sw * cp * vw + cw * sp * vp) * vr,
                sw * cp * ar + cw * ap - sw * vw * vp + (cw * cp * vw - sw * sp * vp) * vr,
                aw - sp * ar - cp * vp * vr,
            ]
        )
        return pose, velocity, acceleration

    def _height(self, t: float) -> Quintic:
        """Return the piece of the height's path that holds at time t (s)."""
        for piece in self.vertical:
            if t < piece.end:
                return piece
        return self.vertical[-1]

    def retarget(
        self, t: float, pose: Array, land: float | None = None, shape: SwingShape | None = None
    ) -> Swing:
        """Return the swing that is on this one at time t (s) and lands at `pose` at `land` (s).

        Position, velocity and acceleration are continuous at t.  A foot that still rises goes
        over an apex high enough for the new sole too; one that comes down goes to it directly,
        or, when it is nearly down and the sole is elsewhere, rises again by the ground clearance.
        Where a later landing would make it overshoot or dip into the ground, it finishes its old
        motion and waits there.  The new swing knows nothing of the times before t.

        Args:
            t: now, s, lift <= t < land.
            pose: sole pose (4, 4) of the new landing.
            land: new landing time, s, > t; None keeps it.
            shape: of the swing from now on; None keeps it.

        Raises:
            InvalidInput: t is not within the swing, or `land` is not after t.
        """
        t = time_of(t)
        land = self.land if land is None else finite_number(land, "land", "s")
        if not self.lift <= t < self.land:
            span = f"{self.lift:.3f} s to {self.land:.3f} s"
            raise InvalidInput(f"t must be within the swing, {span}, got {t}.", argument="t")
        if not land > t:
            raise InvalidInput(f"land must be after t = {t:.3f} s, got {land} s.", argument="land")
        end = as_pose(pose, "pose")
        if shape is not None and shape != self.shape:
            return replace(self, shape=shape).retarget(t, end, land)
        plane, vertical = self._new_plane(t, end, land), self._new_vertical(t, end, land)
        return replace(self, end=end, land=land, plane=plane, vertical=vertical)

    def _new_plane(self, t: float, end: Array, land: float) -> tuple[Quintic, ...]:
        """Return the quintics of the plane from the present motion to another landing."""
        now = tuple(q.at(t) for q in self.plane)
        goal = _near(_coordinates(end), tuple(s[0] for s in now))
        go, arrive = self.shape.way(self.lift, land, t)
        plane = tuple(
            Quintic.between(go, arrive, s, (g, 0.0, 0.0)) for s, g in zip(now, goal, strict=True)
        )
        before = self.plane[0].end
        if t < before < land and _overshoots(plane[0], plane[1]):
            ends = zip(now, goal, strict=True)
            plane = tuple(Quintic.between(t, before, s, (g, 0.0, 0.0)) for s, g in ends)
        return plane

    def _new_vertical(self, t: float, end: Array, land: float) -> tuple[Quintic, ...]:
        """Return the quintics of the height from the present motion to another landing."""
        z0, z1 = float(self.start[2, 3]), float(end[2, 3])
        piece = self._height(t)
        now, target = piece.at(t), sum(piece.coefficients)
        apex, old = self._apex(z0, z1), self._apex(z0, float(self.end[2, 3]))
        rising = target > min(old - 1e-9, now[0])
        if len(self.vertical) == 2 and t < piece.end < self.land and rising:
            top = t + (piece.end - t) * (land - t) / (self.land - t)
            if target < old - 1e-9:
                apex = target  # it rises for the second time, as high as it must
            if apex > target + 1e-9:
                top = max(top, t + 0.35 * (land - t))
            return _over((t, now), (top, max(apex, target)), (land, z1))
        moved = hypot(*(float(end[i, 3] - self.end[i, 3]) for i in (0, 1)))
        if now[0] < z1 + 0.25 * self.ground_clearance and moved > self.ground_clearance:
            return _over((t, now), (t + 0.4 * (land - t), z1 + self.ground_clearance), (land, z1))
        direct = Quintic.between(t, land, now, (z1, 0.0, 0.0))
        floor = min(z1, now[0]) - DIP
        dips = any(direct.at(t + 0.1 * k * (land - t))[0] < floor for k in range(1, 10))
        if not (dips and t < piece.end < land):
            return (direct,)
        # Ending the old descent higher is the old descent plus a rising quintic: never lower.
        share = (land - piece.end) / (land - t)
        wait = target
        if piece.end >= self.land:
            wait = max(target, z1) + 0.5 * share * share * max(0.0, now[0] - max(target, z1))
        return _over((t, now), (piece.end, wait), (land, z1))


def apex_height(
    z0: float,
    z1: float,
    shape: SwingShape,
    swing_height: float,
    ground_clearance: float = GROUND_CLEARANCE,
) -> float:
    """Return the height (m) of a swing's apex over soles at z0 and z1 (m); see `Swing`."""
    least = max(swing_height, shape.height, ground_clearance / RISEN_SHARE)
    return max(z0, z1) + least


def _overshoots(x: Quintic, y: Quintic) -> bool:
    """Return whether a planar path goes more than 1 % of its way beyond its end."""
    x1, y1 = sum(x.coefficients), sum(y.coefficients)
    dx, dy = x1 - x.coefficients[0], y1 - y.coefficients[0]
    times = [x.start + 0.1 * k * (x.end - x.start) for k in range(1, 10)]
    beyond = max((x.at(t)[0] - x1) * dx + (y.at(t)[0] - y1) * dy for t in times)
    return beyond > 0.01 * (dx * dx + dy * dy)


def _over(
    start: tuple[float, State], apex: tuple[float, float], landing: tuple[float, float]
) -> tuple[Quintic, Quintic]:
    """Return the two quintics of the height over an apex, where they rest, to the landing.

    Each is a time (s) and what is then: position, velocity and acceleration, or a height (m).
    """
    (t, now), (middle, height), (land, z1) = start, apex, landing
    rest, last = (height, 0.0, 0.0), (z1, 0.0, 0.0)
    return Quintic.between(t, middle, now, rest), Quintic.between(middle, land, rest, last)


def swing_of(
    plan: FootstepPlan,
    step: Footstep,
    swing_height: float = 0.05,
    ground_clearance: float = GROUND_CLEARANCE,
) -> Swing:
    """Return the swing of one step of a plan, from where its foot stands.

    Args:
        plan: the walk.
        step: one of its steps.
        swing_height: as in `Swing`, m.
        ground_clearance: as in `Swing`, m.

    Raises:
        InvalidInput: no plan, no footstep, or a negative height.
    """
    instance_of(plan, FootstepPlan, "plan")
    instance_of(step, Footstep, "step")
    return Swing(
        plan.start_pose(step),
        step.pose,
        step.lift,
        step.land,
        swing_height,
        ground_clearance,
        step.swing,
    )


def _coordinates(pose: Array) -> tuple[float, ...]:
    """Return x, y, yaw, pitch and roll of a pose."""
    roll, pitch, yaw = rpy_of(pose)
    return float(pose[0, 3]), float(pose[1, 3]), yaw, pitch, roll


def _near(goal: Sequence[float], now: Sequence[float]) -> tuple[float, ...]:
    """Return the goal with its yaw on the same turn as the present one."""
    x, y, yaw, pitch, roll = goal
    return x, y, now[2] + wrap(yaw - now[2]), pitch, roll
