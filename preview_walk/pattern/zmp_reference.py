"""The ZMP reference of a plan: continuous, with continuous velocity, always inside the support.

The ZMP rests at the sole centre in single support and crosses to the next foot in double support
by s(u) = 3 u^2 - 2 u^3.  A preview controller with a jerk input cannot follow a crossing of a few
hundredths of a second, so a crossing shorter than `TRANSFER_TIME` starts before the landing and
ends after the lift, as far as the standing sole allows: with the 31 ms of double support of a
0.8 m/s walk (0.5 m steps, 0.2 m soles) the ZMP error of Katayama's controller falls from 49 mm to
12 mm.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from preview_walk.arguments import LARGEST, instance_of, number_from_zero, real_array, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.support import Sole
from preview_walk.types import Array, other

TRANSFER_TIME = 0.1
"""A crossing of the ZMP from foot to foot lasts this long (s) or longer where the soles allow."""

ZMP_MARGIN = 0.02
"""Default distance (m) of the ZMP reference from the edge of a single standing sole."""


@dataclass(frozen=True, eq=False)
class ZMPReference:
    """A piecewise cubic path of the ZMP on the ground; at rest before the first and last knot.

    Attributes:
        times: knots (K,), s, not decreasing.
        points: ZMP (K, 2) at the knots, world x and y, m.
        slopes: its velocity (K, 2) at the knots, m/s; zero at the first and the last.
    """

    times: Array
    points: Array
    slopes: Array
    _coefficients: Array = field(init=False, repr=False)
    _origins: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Make the polynomials, one per interval and one constant before and after."""
        h = np.diff(self.times)[:, None]
        h = np.where(h > 0.0, h, 1.0)
        rise = np.diff(self.points, axis=0) / h
        m0, m1 = self.slopes[:-1], self.slopes[1:]
        c = np.zeros((len(self.times) + 1, 4, 2))
        c[1:, 0] = self.points
        c[0, 0] = self.points[0]
        c[1:-1, 1] = m0
        c[1:-1, 2] = (3.0 * rise - 2.0 * m0 - m1) / h
        c[1:-1, 3] = (m0 + m1 - 2.0 * rise) / h**2
        object.__setattr__(self, "_coefficients", c)
        object.__setattr__(self, "_origins", np.concatenate((self.times[:1], self.times)))

    def __repr__(self) -> str:
        span = f"{self.times[0]:.3f} s to {self.times[-1]:.3f} s"
        return f"ZMPReference({len(self.times)} knots, {span})"

    def at(self, t: ArrayLike) -> Array:
        """Return the ZMP (m) at time t (s): (2,) for one time, (N, 2) for N times.

        Raises:
            InvalidInput: a time is not a finite number.
        """
        c, u = self._locate(t)
        return np.asarray(c[..., 0, :] + u * (c[..., 1, :] + u * (c[..., 2, :] + u * c[..., 3, :])))

    def velocity(self, t: ArrayLike) -> Array:
        """Return the velocity of the ZMP (m/s) at time t (s): (2,) or (N, 2).

        Raises:
            InvalidInput: a time is not a finite number.
        """
        c, u = self._locate(t)
        return np.asarray(c[..., 1, :] + u * (2.0 * c[..., 2, :] + 3.0 * u * c[..., 3, :]))

    def _locate(self, t: ArrayLike) -> tuple[Array, Array]:
        """Return the polynomials (..., 4, 2) at times t (s), and the times since they began."""
        times = real_array(t, "t", "times in s")
        if not abs(float(times.sum())) <= LARGEST * times.size:
            raise InvalidInput(f"t must be finite times in s, got {shown(t)}.", argument="t")
        i = np.searchsorted(self.times, times, side="right")
        return self._coefficients.take(i, axis=0), (times - self._origins.take(i))[..., None]


def zmp_reference(
    plan: PlanLike, sole: Sole | None = None, margin: float = ZMP_MARGIN
) -> ZMPReference:
    """Return the ZMP reference of a plan.

    Before the first lift, after the last landing and in every stand of the plan the ZMP rests
    midway between the soles; it leaves and reaches that point in `plan.weight_shift` seconds.

    Args:
        plan: the walk; whatever `as_plan` takes.
        sole: half sizes of the soles; bounds how far a crossing reaches into single support.
        margin: distance (m) that the ZMP keeps from the edge of the only standing sole; the sole
            centre is always allowed.

    Raises:
        InvalidInput: no plan, no sole, or a margin that is not >= 0.
    """
    plan, margin = as_plan(plan), number_from_zero(margin, "margin", "m")
    sole = Sole() if sole is None else instance_of(sole, Sole, "sole")
    weight_shift, n = plan.weight_shift, len(plan.steps)
    poses = np.array([s.pose for s in plan])
    standing, stance = _standing(plan)
    centres = poses[:, :2, 3]
    midfeet = 0.5 * (centres[standing[:, 0]] + centres[standing[:, 1]])
    still = np.zeros((1, 2))
    if n == 0:
        return ZMPReference(np.array([plan.start]), midfeet, still)
    rest = centres[stance]
    lift = np.array([s.lift for s in plan.steps])
    land = np.array([s.land for s in plan.steps])
    first = np.array([lift[0] - min(weight_shift, lift[0] - plan.start), lift[0]])
    last = np.array([land[-1], land[-1] + weight_shift])
    # Double supports between steps: four knots each, either one crossing or a stop at midfeet.
    a, b = land[:-1], lift[1:]
    across = rest[1:] - rest[:-1]
    limit = np.minimum(
        _share_inside(poses[stance[:-1]], across, sole, margin),
        _share_inside(poses[stance[1:]], across, sole, margin),
    )
    air = 0.5 * (land - lift)
    extra, share, slope = _crossing(b - a, np.minimum(air[:-1], air[1:]), limit)
    stands = np.array([plan.is_stand(pause) for pause in (b - a).tolist()], dtype=bool)
    times = np.where(
        stands,
        np.array([a, a + weight_shift, b - weight_shift, b]),
        np.array([a - extra, a, b, b + extra]),
    )
    way = (share[:, None] * across, slope[:, None] * across)
    points, slopes = _knots(stands[:, None], rest, midfeet[1:-1], way)
    return ZMPReference(
        np.concatenate((first, times.T.ravel(), last)),
        np.concatenate(
            (midfeet[:1], rest[:1], points.swapaxes(0, 1).reshape(-1, 2), rest[-1:], midfeet[-1:])
        ),
        np.concatenate((still, still, slopes.swapaxes(0, 1).reshape(-1, 2), still, still)),
    )


def _knots(
    stop: NDArray[np.bool_], rest: Array, middle: Array, way: tuple[Array, Array]
) -> tuple[Array, Array]:
    """Return points and slopes (4, n, 2) at the knots of the double supports between steps.

    Args:
        stop: (n, 1) whether the ZMP stops between the feet.
        rest: (n + 1, 2) the standing sole's centre in each step, m.
        middle: (n, 2) the middle of the feet in each double support, m.
        way: (n, 2) each, how far a crossing is at its landing, m, and how fast then, m/s.
    """
    before, speed = way
    points = np.array(
        [
            rest[:-1],
            np.where(stop, middle, rest[:-1] + before),
            np.where(stop, middle, rest[1:] - before),
            rest[1:],
        ]
    )
    moving = np.where(stop, 0.0, speed)
    return points, np.array([np.zeros_like(moving), moving, moving, np.zeros_like(moving)])


def _standing(plan: FootstepPlan) -> tuple[np.ndarray, np.ndarray]:
    """Return which footsteps bear the robot.

    Returns:
        Indices into the plan: (n + 1, 2) of the left and right sole that stand at the start and
        after each landing, and (n,) of the sole that stands in each step.
    """
    now = {"left": 0, "right": 1}
    standing, stance = [(0, 1)], []
    for index, step in enumerate(plan.steps):
        stance.append(now[other(step.foot)])
        now[step.foot] = index + 2
        standing.append((now["left"], now["right"]))
    return np.array(standing), np.array(stance, dtype=int)


def _share_inside(poses: Array, across: Array, sole: Sole, margin: float) -> Array:
    """Return which share (n,) of a crossing (n, 2) from a sole's centre stays on that sole."""
    # Horizontal displacement -> coordinates on the (sloped) sole plane.
    local = np.abs(np.linalg.solve(poses[:, :2, :2], across[..., None])[..., 0])
    inner = np.array([sole.half_length - margin, sole.half_width - margin]).clip(0.0)
    return np.asarray((inner / local.clip(1e-9)).min(axis=1).clip(0.0, 0.49))


def _crossing(pause: Array, room: Array, limit: Array) -> tuple[Array, Array, Array]:
    """Return how crossings reach beyond their double supports.

    Args:
        pause: duration of the double supports (n,), s.
        room: longest reach into the single supports before and after (n,), s.
        limit: share of the crossing that may be done there (n,).

    Returns:
        Reach (n,) in s, share (n,) done in each reach, and the share's rate (n,) in 1/s at its
        end.  Where `limit` allows, the crossing is the cubic over the whole time; else the reach
        takes as much of it as is allowed, no slower than the double support goes on average.
    """
    extra = np.minimum(0.5 * (TRANSFER_TIME - pause).clip(0.0), room)
    total = pause + 2.0 * extra
    u = extra / total
    share = u * u * (3.0 - 2.0 * u)
    slope = 6.0 * u * (1.0 - u) / total
    short = share > limit
    brisk = 3.0 * limit * pause / (1.0 - 2.0 * limit)
    reach = np.where(short, np.minimum(extra, brisk), extra)
    share = np.where(short, limit, share)
    steepest = 3.0 * share / np.where(reach > 0.0, reach, 1.0)
    return reach, share, np.where(short, np.minimum(slope, steepest), slope)
