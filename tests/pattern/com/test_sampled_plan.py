"""A sampled plan: the DCM of a ZMP that runs straight, windows past the end."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from walker_stand_in import MODEL, slow_walk

from preview_walk.pattern.com.sampled_plan import (
    AHEAD,
    PLANNING_DT,
    RENEWAL,
    SPAN,
    sample_plan,
)
from preview_walk.pattern.dcm import planned_dcm
from preview_walk.pattern.swing_moment import swing_zmp_shift
from preview_walk.pattern.zmp_reference import zmp_reference

SAMPLED = sample_plan(slow_walk(3), 0.0, 0, MODEL)


def test_the_dcm_of_straight_lines_solves_its_equation() -> None:
    """Integrated backwards by Runge and Kutta from the end, where it rests on the ZMP."""
    ticks = np.arange(len(SAMPLED.zmp)) * PLANNING_DT
    omega = SAMPLED.omega
    for axis in (0, 1):
        zmp = SAMPLED.zmp[:, axis]
        run = solve_ivp(
            lambda t, xi, zmp=zmp: omega * (xi - np.interp(t, ticks, zmp)),
            (ticks[-1], 0.0), [zmp[-1]], t_eval=ticks[::-20], max_step=PLANNING_DT,
            rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        assert np.abs(run.y[0] - SAMPLED.dcm_of_lines[::-20, axis]).max() < 1e-6


def test_the_dcm_of_held_samples_lags_it_by_half_a_tick() -> None:
    middle = 0.5 * (SAMPLED.dcm_of_lines[1:] + SAMPLED.dcm_of_lines[:-1])
    assert np.abs(middle - SAMPLED.dcm[1:]).max() < 1e-4
    assert np.abs(SAMPLED.dcm_of_lines - SAMPLED.dcm).max() > 1e-3


def test_past_the_end_the_last_sample_holds() -> None:
    last = len(SAMPLED.zmp) - 1
    assert (SAMPLED.window(SAMPLED.zmp, last - 3)[:3] == SAMPLED.zmp[-3:]).all()
    assert (SAMPLED.window(SAMPLED.zmp, last + 50) == SAMPLED.zmp[-1]).all()
    assert SAMPLED.window(SAMPLED.zmp, last).shape == (AHEAD, 2)
    assert SAMPLED.index(last + 50) == last


def test_sampled_later_it_is_the_same() -> None:
    later = sample_plan(slow_walk(3), 0.0, 200, MODEL)
    both = len(SAMPLED.zmp) - 200
    assert np.abs(later.zmp[:both] - SAMPLED.zmp[200:]).max() < 1e-12
    assert np.abs(later.dcm_of_lines[:both] - SAMPLED.dcm_of_lines[200:]).max() < 1e-12
    assert np.abs(later.planned_dcm(250.3) - SAMPLED.planned_dcm(250.3)).max() < 1e-12


@pytest.mark.parametrize("tick", [0, *range(1200, 1420, 20), 4000])
def test_a_part_of_a_long_plan_is_that_part_of_the_whole(tick: int) -> None:
    plan = slow_walk(30)
    part = sample_plan(plan, 0.0, tick, MODEL)
    times = PLANNING_DT * np.arange(tick, int(plan.end / PLANNING_DT) + 400)
    shift = swing_zmp_shift(plan, times, MODEL.momentum, MODEL.swing_height)
    zmp = zmp_reference(plan, MODEL.sole).at(times) - shift
    many = min(len(part.zmp), len(zmp))
    assert len(part.zmp) == SPAN + AHEAD + 2
    assert np.abs(part.zmp - zmp[:many]).max() < 1e-12
    assert part.suffices(tick + SPAN - RENEWAL)
    assert not part.suffices(tick + SPAN - RENEWAL + 1)
    dcm = planned_dcm(zmp, MODEL.omega * PLANNING_DT)
    assert np.abs(part.dcm - dcm[:many])[: SPAN - RENEWAL].max() < 1e-5


def test_the_end_of_a_plan_needs_no_more_samples() -> None:
    assert sample_plan(slow_walk(3), 0.0, 500, MODEL).suffices(10**6)
