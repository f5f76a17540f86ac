"""Wieber's walk live: the ZMP on the soles at all times, the least jerk, always an answer."""

import copy
import pickle

import numpy as np
import pytest
import qpsolvers
from walker_stand_in import MODEL, SOLE, slow_walk

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.pattern.com import mpc
from preview_walk.pattern.com.mpc import PERIOD, SAMPLES, MpcGenerator, MpcState
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, SampledPlan, sample_plan
from preview_walk.pattern.zmp_reference import ZMP_MARGIN
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, Array

GENERATOR = MpcGenerator(MODEL.pendulum_height)
PLAN = slow_walk(4)
SAMPLED = sample_plan(PLAN, 0.0, 0, MODEL)


def walked(sampled: SampledPlan, state: MpcState, ticks: int) -> list[MpcState]:
    states = [state]
    for tick in range(ticks):
        states.append(GENERATOR.step(states[-1], sampled, tick))
    return states


def at_rest() -> MpcState:
    com = SAMPLED.zmp[0]
    return GENERATOR.rejoin(com, com, com)


def margin(plan: FootstepPlan, t: float, zmp: Array) -> float:
    """Return how far (m) a ZMP is within the true soles at a time (s)."""
    phase = plan.support(t)
    feet = FEET if phase == DOUBLE_SUPPORT else FEET[:1] if phase == LEFT_SUPPORT else FEET[1:]
    return float(support_margin(support_polygon([plan.sole(f, t) for f in feet], SOLE), zmp))


def test_the_zmp_is_on_the_soles_between_the_samples_too() -> None:
    states = walked(SAMPLED, at_rest(), len(SAMPLED.zmp) - 1)
    margins = [
        margin(PLAN, tick * PLANNING_DT, state.zmp + SAMPLED.shift[tick])
        for tick, state in enumerate(states)
    ]
    # 20 mm are asked for at the samples; between them the swing's shift is not a straight line.
    assert min(margins[PERIOD::PERIOD]) > ZMP_MARGIN - 1e-6
    assert min(margins) > 0.015
    reference = np.abs(np.array([s.zmp for s in states]) - SAMPLED.zmp).max()
    assert reference > 0.03  # nothing asks for the middle of the soles


def test_no_jerks_are_less() -> None:
    """The same problem by another solver, in the middle of the walk."""
    state = walked(SAMPLED, at_rest(), 400)[-1]
    rows, bounds = GENERATOR._conditions(state, SAMPLED, 400)
    size = 2 * SAMPLES
    expected = qpsolvers.solve_qp(np.eye(size), np.zeros(size), rows, bounds, solver="daqp")
    path = GENERATOR._foreseen(state, SAMPLED, 400)
    jerks = np.array([s.jerk for s in path[1:]])
    assert jerks.T.ravel() == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_what_is_foreseen_is_what_is_walked_until_the_next_problem() -> None:
    states = walked(SAMPLED, at_rest(), 300)
    following = states[297]
    assert following.solved == 296
    for tick in range(296, 301):
        expected = states[tick].com + states[tick].velocity / MODEL.omega
        assert GENERATOR.dcm(following, SAMPLED, float(tick)) == pytest.approx(expected, abs=1e-12)
    # Later problems know more of the plan, but not much.
    later = states[300].com + states[300].velocity / MODEL.omega
    early = GENERATOR.dcm(states[201], SAMPLED, 300.0)
    assert early == pytest.approx(later, abs=2e-3)
    assert GENERATOR.dcm(following, SAMPLED, 296.0 + PERIOD * SAMPLES) == pytest.approx(
        SAMPLED.planned_dcm(296.0 + PERIOD * SAMPLES)
    )


def test_another_plan_is_answered_at_once() -> None:
    state = walked(SAMPLED, at_rest(), 202)[-1]
    assert GENERATOR.step(state, SAMPLED, 202).solved == 200
    other = sample_plan(PLAN.replace_after(202 * PLANNING_DT, []), 0.0, 202, MODEL)
    assert GENERATOR.step(state, other, 202).solved == 202


def test_without_a_solution_the_com_coasts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mpc, "least_distance", lambda rows, bounds: None)
    state = walked(SAMPLED, at_rest(), 3)[-1]
    assert (state.com == at_rest().com).all()
    assert (state.array[1:4] == 0.0).all()


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
def test_a_copy_of_a_state_goes_on_as_it_does(copied: object) -> None:
    state = walked(SAMPLED, at_rest(), 202)[-1]
    twin, sampled = copied((state, SAMPLED))  # type: ignore[operator]
    assert not twin.array.flags.writeable
    for tick in range(202, 210):
        state, twin = GENERATOR.step(state, SAMPLED, tick), GENERATOR.step(twin, sampled, tick)
        assert (twin.array == state.array).all()
        assert twin.solved == state.solved
