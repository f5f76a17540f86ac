"""Swings over edges: the whole sole stays above the ground all the way, by another computation."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.clearing import ASIDE, LEAST_HEIGHT, clearing_shape
from preview_walk.footsteps.laying import UNEVEN, lay_on, relay
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.swing_shape import PLAIN, SwingShape
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.pattern.swing import Swing, swing_of
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.shapes import blocks, ramps, slope, stairs, stepping_stones
from preview_walk.terrain.slabs import Slab, SlabGround

SOLE = Sole(0.1, 0.06)
LIMITS = GaitLimits(sole=SOLE, forward=0.7)
PLANNER = FootstepPlanner(0.28, 0.2, 1.0)

GROUNDS = {
    "up": stairs(0.18, 0.28, 4),
    "down": stairs(-0.18, 0.28, 4),
    "up and back": stairs(0.1, 0.35, 3, back=True),
    "slope": slope(12.0, bank=5.0, length=2.0),
    "steep": slope(-15.0, length=2.0),
    "ramps": ramps(10.0, 0.6),
    "blocks": blocks(0.06, 0.4, length=3.0, seed=3),
    "stones": stepping_stones(0.3, 0.1, 6, width=0.22),
}


def room(swing: Swing, ground: Ground) -> float:
    """Return the least height (m) of the sole's points over the ground, between 5 and 95 %."""
    grid = np.array([(x, y, 0.0, 1.0) for x, y in product(np.linspace(-1, 1, 9), (-1, 0, 1))])
    grid[:, :2] *= (SOLE.half_length, SOLE.half_width)
    worst = np.inf
    for share in np.linspace(0.05, 0.95, 91):
        pose, _, _ = swing.at(swing.lift + share * (swing.land - swing.lift))
        x, y, z, _ = pose @ grid.T
        worst = min(worst, float((z - ground.height(x, y)).min()))
    return worst


WALKS = [(name, 0.0) for name in GROUNDS] + [(name, 0.04) for name in ("slope", "ramps", "blocks")]


@pytest.mark.parametrize(("name", "turn"), WALKS)
def test_no_point_of_the_sole_meets_the_ground_on_its_way(name: str, turn: float) -> None:
    ground = GROUNDS[name]
    plan = lay_on(PLANNER.generate_footsteps(10, turn=turn), ground, LIMITS)
    for step in plan.steps:
        # Near its ends a sole is as deep in the highest points as footholds may be uneven.
        assert room(swing_of(plan, step, LEAST_HEIGHT), ground) > -UNEVEN - 1e-3


def test_edges_shape_the_swing_and_level_ground_does_not() -> None:
    up = lay_on(PLANNER.generate_footsteps(6), stairs(0.18, 0.28, 6), LIMITS).steps[3].swing
    down = lay_on(PLANNER.generate_footsteps(6), stairs(-0.18, 0.28, 6), LIMITS).steps[3].swing
    assert up.before > up.after == 0.0
    assert down.after > down.before == 0.0
    assert up.apex > 0.5 > down.apex
    flat = lay_on(PLANNER.generate_footsteps(6), FlatGround(), LIMITS)
    assert {step.swing for step in flat} == {PLAIN}


def test_a_wall_between_two_places_is_stepped_over() -> None:
    """A beam of 4 cm, 12 cm high: the plain swing would run into it."""
    beam = SlabGround((Slab(0.25, 0.0, 0.12, 0.02, 1.0),))
    start, end = pose_at(0.0, 0.1), pose_at(0.5, 0.1)
    shape = clearing_shape(start, end, beam, SOLE)
    plain = Swing(start, end, 0.0, 1.0, LEAST_HEIGHT)
    assert room(plain, beam) < -0.02
    assert room(Swing(start, end, 0.0, 1.0, LEAST_HEIGHT, shape=shape), beam) > 0.0


def test_a_swing_keeps_its_shape() -> None:
    """Rise, way and descent take the shares that the shape says."""
    swing = Swing(
        pose_at(0.0, 0.1), pose_at(0.4, 0.1), 1.0, 2.0, shape=SwingShape(0.1, 0.2, 0.3, 0.4)
    )
    assert swing.at(1.2)[0][0, 3] == 0.0
    assert swing.at(1.25)[0][0, 3] > 0.0
    assert swing.at(1.7)[0][0, 3] == pytest.approx(0.4, abs=1e-12)
    assert swing.at(1.4)[0][2, 3] == pytest.approx(0.1)
    assert swing.at(1.4)[1][2] == pytest.approx(0.0, abs=1e-12)
    moved = swing.retarget(1.1, pose_at(0.5, 0.1))
    assert moved.at(1.2)[0][0, 3] == 0.0
    assert moved.at(1.7)[0][0, 3] == pytest.approx(0.5, abs=1e-12)


def test_only_new_steps_are_laid_again() -> None:
    ground = stairs(0.1, 0.3, 5)
    plan = lay_on(PLANNER.generate_footsteps(8), ground, LIMITS)
    assert relay(plan, plan, ground, LIMITS) is plan
    flat = FootstepPlan([*plan[:5], *PLANNER.generate_footsteps(8)[5:]])
    again = relay(flat, plan, ground, LIMITS)
    assert all(a is b for a, b in zip(again[:5], plan[:5], strict=True))
    for step, before in zip(again[5:], plan[5:], strict=True):
        assert step.pose == pytest.approx(before.pose, abs=1e-12)
        assert step.swing == before.swing


def test_a_step_without_room_lands_on_the_highest_point() -> None:
    """Recovery steps must land somewhere: across an edge they stand on its upper side."""
    ground = stairs(0.1, 0.12, 12)  # treads shorter than a sole
    flat = PLANNER.generate_footsteps(5)
    laid = relay(flat, FootstepPlan(flat[:2]), ground, LIMITS)
    last = laid.steps[-1].pose
    assert last[:2, 3] == pytest.approx(flat.steps[-1].pose[:2, 3])
    toe = float(ground.height(last[0, 3] + SOLE.half_length, last[1, 3]))
    assert last[2, 3] == pytest.approx(toe)
    assert toe > 0.3
    assert last[:3, 2] == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize(
    ("values", "argument"),
    [
        ({"height": -0.1}, "height"),
        ({"before": -0.1}, "before"),
        ({"before": 0.5, "after": 0.5}, "before"),
        ({"apex": 0.0}, "apex"),
        ({"apex": float("nan")}, "apex"),
        ({"after": "late"}, "after"),
    ],
)
def test_shapes_that_cannot_be(values: dict[str, float], argument: str) -> None:
    with pytest.raises(InvalidInput) as told:
        SwingShape(**values)
    assert told.value.argument == argument


def test_soles_pass_beside_higher_edges() -> None:
    """A wall beside the way, nearer than `ASIDE`, is cleared; a little further it is not."""
    start, end = pose_at(0.0, 0.0), pose_at(0.4, 0.0)
    for gap, cleared in ((ASIDE - 2e-3, True), (ASIDE + 2e-3, False)):
        wall = SlabGround((Slab(0.2, SOLE.half_width + gap + 0.1, 0.1, 0.02, 0.1),))
        assert (clearing_shape(start, end, wall, SOLE).height > 0.1) == cleared
