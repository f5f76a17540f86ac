"""A sampled plan: the DCM of a ZMP that runs straight, windows past the end."""

import numpy as np
from scipy.integrate import solve_ivp
from walker_stand_in import MODEL, slow_walk

from preview_walk.pattern.com.sampled_plan import AHEAD, PLANNING_DT, sample_plan

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
    assert np.abs(later.zmp - SAMPLED.zmp[200:]).max() < 1e-12
    assert np.abs(later.dcm_of_lines - SAMPLED.dcm_of_lines[200:]).max() < 1e-12
    assert np.abs(later.planned_dcm(250.3) - SAMPLED.planned_dcm(250.3)).max() < 1e-12
