"""What the soles feel of a ground that nobody sees: where it is, how it is tilted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from preview_walk.controller.feet import FootState
from preview_walk.footsteps.laying import on_plane
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.swing_shape import SwingShape
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Plane
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot, other

CONFORM_RATE = 3.0
"""A sole that stands on its very edge, while the load should be in its middle, turns so fast
(rad/s) towards the ground."""

CONFORM_TIME = 0.3
"""So long (s) after it has come to stand a sole turns; later it would rock."""

AS_PLANNED = 0.4
"""A centre of pressure this near to where it should be (in half sizes) is there."""

TRUST = 0.5
"""Share of the tilt of one sole that is believed at once: on a block's edge it says little of the
ground ahead, on a slope all soles say the same."""

STEEPEST = 0.35
"""Ground is never taken to rise by more (m per m)."""

CAREFUL = SwingShape(before=0.1, after=0.25)
"""The swing over ground that nobody sees: it comes down upright, whenever it touches."""

LEAST_LOAD = 20.0
"""A sole that carries less (N) does not say where it is pressed."""


class FeltGround:
    """The ground as the soles have felt it up to now.

    Attributes:
        plane: what it is taken to be.
    """

    def __init__(self, plan: FootstepPlan) -> None:
        """Take the ground to be as the plan's first sole lies."""
        self.plane = Plane.through(plan[0].pos, plan[0].pose[:3, 2])

    def feel(
        self,
        t: float,
        plan: FootstepPlan,
        feet: tuple[Mapping[Foot, FootState], Mapping[Foot, FootState]],
        soles: Mapping[Foot, Array],
    ) -> FootstepPlan | None:
        """Return the plan on the ground as it has just been felt; None if no foot tells anything.

        Args:
            t: now, s.
            plan: the walk.
            feet: at the tick before, and now.
            soles: measured poses (4, 4), world, m.
        """
        felt = None
        for foot, plane in felt_planes(*feet, soles, self.plane):
            self.plane = plane
            felt = on_plane(plan if felt is None else felt, foot, t, plane)
        return felt


def settling(
    t: float,
    feet: Mapping[Foot, FootState],
    wrench: Mapping[Foot, Array],
    body: WholeBodyController,
) -> Iterator[tuple[Foot, Array]]:
    """Yield the feet that stand on an edge, and the twist (6,) with which each comes to lie.

    Args:
        t: now, s.
        feet: as they are.
        wrench: [force; moment] (6,) measured under each sole, world axes, N, N·m.
        body: with what the last tick planned.
    """
    for foot, state in feet.items():
        if state.contact and t - state.since < CONFORM_TIME:
            rotation = body.dynamics.soles[foot].rotation
            twist = conforming(wrench[foot], body.wrench(foot), rotation, body.robot.sole)
            if twist is not None:
                yield foot, twist


def felt_planes(
    before: Mapping[Foot, FootState],
    now: Mapping[Foot, FootState],
    soles: Mapping[Foot, Array],
    plane: Plane,
) -> Iterator[tuple[Foot, Plane]]:
    """Yield the feet that have just told something of the ground, and the ground by them.

    A foot that touches it tells its height, one that stands alone its tilt too.

    Args:
        before: the feet at the tick before.
        now: the feet.
        soles: measured poses (4, 4), world, m.
        plane: the ground as it was taken to be.
    """
    for foot in FEET:
        if now[foot].felt and not before[foot].felt:
            yield foot, Plane.through(soles[foot][:3, 3], plane.normal(0.0, 0.0))
        elif before[foot].contact and not now[foot].contact:
            stands = soles[other(foot)]
            felt = Plane.through(stands[:3, 3], stands[:3, 2])
            ahead = plane.ahead + TRUST * (felt.ahead - plane.ahead)
            left = plane.left + TRUST * (felt.left - plane.left)
            normal = Plane(0.0, *np.clip((ahead, left), -STEEPEST, STEEPEST)).normal(0.0, 0.0)
            yield other(foot), Plane.through(stands[:3, 3], normal)


def conforming(wrench: Array, planned: Array, rotation: Array, sole: Sole) -> Array | None:
    """Return the twist (6,) with which a sole comes to lie on the ground, or None where it does.

    Pressed at an edge where the load should be further in, it turns about that edge, the faster
    the further both are apart.

    Args:
        wrench: [force; moment] (6,) measured about the sole's centre, world axes, N, N·m.
        planned: the same that the last tick wanted.
        rotation: (3, 3) of the sole.
        sole: half sizes, m.
    """
    force, wanted = rotation.T @ wrench[:3], rotation.T @ planned[:3]
    if force[2] < LEAST_LOAD or wanted[2] < LEAST_LOAD:
        return None
    half = np.array((sole.half_length, sole.half_width))
    here = _pressed(force, rotation.T @ wrench[3:])
    off = (here - _pressed(wanted, rotation.T @ planned[3:])) / half
    off = np.sign(off) * np.maximum(np.abs(off) - AS_PLANNED, 0.0)
    if not off.any():
        return None
    here = np.clip(here, -half, half)
    turn = CONFORM_RATE * np.array((off[1], -off[0], 0.0))
    return np.concatenate([-np.cross(turn, (*here, 0.0)), turn])


def _pressed(force: Array, moment: Array) -> Array:
    """Return the centre of pressure (2,), m, in the axes of force and moment (3,)."""
    pressed: Array = np.array((-moment[1], moment[0])) / force[2]
    return pressed
