"""The CoM over a whole plan is the one that the walking pattern gives tick by tick."""

from __future__ import annotations

import numpy as np
import pytest
from walker_stand_in import LEGS, MODEL, slow_walk

from preview_walk.geometry.poses import midfeet
from preview_walk.pattern.com.sampled_plan import AHEAD, SPAN
from preview_walk.pattern.com_path import com_path
from preview_walk.pattern.walking_pattern import WalkingPattern


@pytest.mark.parametrize("steps", [2, 12])
def test_it_is_that_of_the_pattern_to_the_end_of_the_plan(steps: int) -> None:
    plan = slow_walk(steps)
    times, com = com_path(plan, MODEL)
    assert times[-1] > plan.end
    assert (steps == 2) == (len(times) < SPAN + AHEAD)
    x, y, _ = midfeet(plan[0].pose, plan[1].pose)
    pattern = WalkingPattern(plan, np.array((x, y, LEGS.com_height)), MODEL)
    walked = np.array([pattern.at(float(t)).com for t in times if t < plan.end])
    np.testing.assert_allclose(com[: len(walked)], walked, atol=1e-6)
