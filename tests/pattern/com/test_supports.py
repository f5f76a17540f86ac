"""The supports of a plan: both soles, one, and which of them around a change."""

import numpy as np
from walker_stand_in import SOLE, slow_walk

from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.pattern.com.supports import Supports
from preview_walk.pattern.zmp_reference import ZMP_MARGIN
from preview_walk.types import FEET

PLAN = slow_walk(3)
TIMES = np.arange(1200) * 0.005
SUPPORTS = Supports(PLAN, SOLE, TIMES)


def margin_of(sample: int, point: np.ndarray, reach: int) -> float:
    """Return how far (m) a point is within the support of a sample."""
    ((normals, offsets),) = SUPPORTS.around(np.array([sample]), reach)
    return float((offsets - normals @ point).min())


def test_one_sole_while_the_other_swings_and_both_otherwise() -> None:
    step = PLAN.steps[1]
    other = "left" if step.foot == "right" else "right"
    for t, feet in ((0.5 * (step.lift + step.land), [other]), (0.05, list(FEET))):
        soles = [PLAN.sole(foot, t) for foot in feet]
        polygon = support_polygon(soles, SOLE)
        centre = np.mean([sole[:2, 3] for sole in soles], axis=0)
        margin = margin_of(round(t / 0.005), centre, 0)
        assert abs(margin - (support_margin(polygon, centre) - ZMP_MARGIN)) < 1e-12


def test_near_a_change_only_the_sole_that_stands_before_and_after_counts() -> None:
    step = PLAN.steps[1]
    before = int(step.lift / 0.005) - 2  # 10 to 15 ms before the foot lifts
    lifting = PLAN.sole(step.foot, step.lift)[:2, 3]
    assert margin_of(before, lifting, 0) > 0.0
    assert margin_of(before, lifting, 4) < -0.05
    after = int(step.land / 0.005) + 2
    assert margin_of(after, step.pose[:2, 3], 0) > 0.0
    assert margin_of(after, step.pose[:2, 3], 4) < -0.05


def test_a_double_support_that_is_too_short_for_that_keeps_both_soles() -> None:
    first, second = PLAN.steps[1:3]
    middle = round(0.5 * (first.land + second.lift) / 0.005)
    for sole in (PLAN.sole(first.foot, first.land), PLAN.sole(second.foot, first.land)):
        assert margin_of(middle, sole[:2, 3], 50) > 0.0  # 0.25 s either way; it lasts 0.18 s


def test_at_a_landing_the_sole_stands_where_it_landed() -> None:
    """At the very instant, and in every double support: not where the one before had it."""
    lands = [step.land for step in PLAN.steps]
    supports = Supports(PLAN, SOLE, np.sort(np.append(TIMES, lands)))
    for step in PLAN.steps:
        sample = np.searchsorted(np.sort(np.append(TIMES, lands)), step.land)
        for normals, offsets in supports.around(np.array([sample, sample + 1]), 0):
            assert (offsets - normals @ step.pose[:2, 3]).min() > 0.0
