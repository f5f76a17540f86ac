"""Plans laid on a ground: each sole lies on one plane, its corners on the ground."""

from __future__ import annotations

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.laying import CLEAR, UNEVEN, lay_on
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import yaw_of
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.shapes import blocks, slope, stairs

SOLE = Sole(0.1, 0.06)
LIMITS = GaitLimits(sole=SOLE, forward=0.7, rise=0.2)
PLANNER = FootstepPlanner(0.25, 0.2, 0.8)


@pytest.mark.parametrize(
    "ground",
    [
        slope(10.0),
        slope(-10.0),
        slope(6.0, bank=5.0),
        stairs(0.15, 0.28, 6, back=True),
        stairs(-0.15, 0.3, 6),
        blocks(0.05, 0.4),
    ],
)
@pytest.mark.parametrize("turn", [0.0, 0.05])
def test_every_corner_of_every_sole_is_on_the_ground(ground: Ground, turn: float) -> None:
    flat = PLANNER.generate_footsteps(10, turn=turn)
    plan = lay_on(flat, ground, LIMITS)
    for step, before in zip(plan, flat, strict=True):
        corners = SOLE.corners(step.pose)
        heights = ground.height(corners[:, 0], corners[:, 1])
        assert np.abs(corners[:, 2] - heights).max() < UNEVEN
        assert (step.foot, step.lift, step.land) == (before.foot, before.lift, before.land)
        assert yaw_of(step.pose) == pytest.approx(before.yaw, abs=1e-12)


def test_a_level_ground_changes_nothing_but_the_height() -> None:
    flat = PLANNER.generate_footsteps(4)
    for step, before in zip(lay_on(flat, FlatGround(0.3), LIMITS), flat, strict=True):
        assert step.pose[:2, :] == pytest.approx(before.pose[:2, :], abs=1e-12)
        assert step.pose[2, 3] == pytest.approx(0.3)


def test_a_foothold_across_an_edge_moves_the_shortest_way_off_it() -> None:
    """The first edge of the stairs is at 0.5 m: a sole of 0.1 m and 1 cm stays 0.11 m from it."""
    ground = stairs(0.1, 1.0, 1)
    for length, wanted in ((0.45, 0.39), (0.56, 0.61)):
        planner = FootstepPlanner(length, 0.2, 0.8)
        plan = lay_on(planner.generate_footsteps(2), ground, LIMITS)
        assert plan.steps[0].pos[0] == pytest.approx(wanted, abs=0.011)
        assert abs(plan.steps[0].pos[0] - 0.5) >= SOLE.half_length + CLEAR - 1e-9


def test_where_no_sole_has_room_it_is_said_which_step() -> None:
    sentence = r"^the ground has no plane place of 0\.200 x 0\.120 m within 0\.2 m of where step \d"
    with pytest.raises(InvalidInput, match=sentence) as told:
        lay_on(PLANNER.generate_footsteps(6), stairs(0.1, 0.15, 6), LIMITS)
    assert told.value.argument == "ground"
