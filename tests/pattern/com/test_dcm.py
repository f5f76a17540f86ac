"""The CoM that follows the plan's DCM: exact, on the plan's ZMP, back on it after a jump."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from walker_stand_in import MODEL, fast_walk, slow_walk

from preview_walk.pattern.com.dcm import DcmGenerator
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, SampledPlan, sample_plan
from preview_walk.preview.cart_table import ComState

OMEGA = MODEL.omega
GENERATOR = DcmGenerator(MODEL.pendulum_height)


def walked(sampled: SampledPlan, state: ComState, first: int, last: int) -> list[ComState]:
    states = [state]
    for tick in range(first, last):
        states.append(GENERATOR.step(states[-1], sampled, tick))
    return states


@pytest.mark.parametrize("plan", [slow_walk(), fast_walk()])
def test_the_zmp_is_the_plans(plan: object) -> None:
    """From the plan's DCM on, with no error to bring back: to rounding, over the whole walk."""
    sampled = sample_plan(plan, 0.0, 0, MODEL)  # type: ignore[arg-type]
    com = sampled.zmp[0]
    start = GENERATOR.rejoin(com, sampled.dcm_of_lines[0], sampled.zmp[0])
    states = walked(sampled, start, 0, len(sampled.zmp) - 1)
    assert np.abs(np.array([s.zmp for s in states]) - sampled.zmp).max() < 1e-12
    dcm = np.array([s.com + s.velocity / OMEGA for s in states])
    assert np.abs(dcm - sampled.dcm_of_lines).max() < 1e-12


def test_between_ticks_it_is_the_pendulums_motion() -> None:
    """c' = omega (xi - c), xi' = omega (xi - p) by Runge and Kutta, p straight in between."""
    sampled = sample_plan(slow_walk(2), 0.0, 0, MODEL)
    state = GENERATOR.rejoin(np.array((0.01, -0.02)), np.array((0.03, 0.01)), np.array((0.0, 0.02)))
    following = GENERATOR.step(state, sampled, 0)
    rate = (following.zmp - state.zmp) / PLANNING_DT

    def pendulum(t: float, y: np.ndarray) -> np.ndarray:
        com, dcm = y[:2], y[2:]
        zmp = state.zmp + rate * t
        return np.concatenate([OMEGA * (dcm - com), OMEGA * (dcm - zmp)])

    start = np.concatenate([state.com, state.com + state.velocity / OMEGA])
    for tau in (0.0, 0.0013, PLANNING_DT):
        run = solve_ivp(pendulum, (0.0, tau), start, rtol=1e-12, atol=1e-14)
        found = GENERATOR.interpolate(state, following, tau)
        assert found.com == pytest.approx(run.y[:2, -1], abs=1e-12)
        assert found.com + found.velocity / OMEGA == pytest.approx(run.y[2:, -1], abs=1e-12)
        assert found.acceleration == pytest.approx(OMEGA**2 * (found.com - found.zmp), abs=1e-12)
    assert (found.array - following.array) == pytest.approx(0.0, abs=1e-9)


def test_an_error_of_the_dcm_decays_at_the_rate_omega() -> None:
    sampled = sample_plan(slow_walk(), 0.0, 0, MODEL)
    off = np.array((0.02, -0.01))
    start = GENERATOR.rejoin(sampled.zmp[0], sampled.dcm_of_lines[0] + off, sampled.zmp[0])
    states = walked(sampled, start, 0, 200)
    dcm = np.array([s.com + s.velocity / OMEGA for s in states])
    errors = dcm - sampled.dcm_of_lines[:201]
    # The ZMP goes there in the course of a tick: omega to first order in omega T, 1.6 %.
    for tick in (100, 200):
        rate = -np.log(errors[tick] / off) / (tick * PLANNING_DT)
        assert rate == pytest.approx(OMEGA, rel=0.03)
