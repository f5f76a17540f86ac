"""The preview controller: one law, whole or tick by tick, for any start, anywhere in the world."""

import copy
import pickle
import re
import subprocess
import sys
import warnings
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.preview.cart_table import natural_frequency
from preview_walk.preview.controller import ComState, PreviewController
from preview_walk.preview.horizon import ShortHorizonWarning
from preview_walk.types import Array

LAB = PreviewController()
KAJITA = PreviewController(0.814, 0.005, 1.6)


def walk(dt: float, duration: float = 10.0, stand: float = 0.8) -> Array:
    """Return the lab's walk, (N, 2): steps of 0.15 m every 0.5 s, ZMP moved in 0.1 s ramps."""
    t = np.arange(round(duration / dt) + 1) * dt
    corners, points = [0.0], [(0.0, 0.0)]
    for i, lift in enumerate(np.arange(stand, duration - 2.0, 0.5)):
        corners += [lift, lift + 0.1]
        points += [points[-1], (0.15 * (i + 1), 0.05 * (-1) ** i)]
    columns = np.array(points)
    return np.stack([np.interp(t, corners, columns[:, axis]) for axis in (0, 1)], axis=1)


def run_steps(controller: PreviewController, reference: Array, state: ComState) -> Array:
    """Return the (N, 5, 2) states of `step` run over a reference held past its end."""
    n = controller.n_preview
    held = np.concatenate([reference, np.repeat(reference[-1:], n, axis=0)])
    states = [state]
    for k in range(len(reference) - 1):
        states.append(controller.step(states[-1], held[k + 1 : k + 1 + n]))
    return np.array([state.array for state in states])


@pytest.mark.parametrize("controller", [LAB, KAJITA, PreviewController(0.5, 0.02, 1.0)])
def test_step_run_over_a_reference_is_the_trajectory(controller: PreviewController) -> None:
    reference = walk(controller.dt, 6.0)
    start = controller.initial_state((0.02, -0.01), (0.1, 0.05), (-0.3, 0.2), (2.0, -1.0))
    states = run_steps(controller, reference, start)
    whole = controller.trajectory(reference, start)
    np.testing.assert_allclose(whole.com, states[:, 0], atol=1e-12, rtol=0)
    np.testing.assert_allclose(whole.velocity, states[:, 1], atol=3e-12, rtol=0)
    np.testing.assert_allclose(whole.acceleration, states[:, 2], atol=2e-11, rtol=0)
    np.testing.assert_allclose(whole.jerk, states[:, 3], atol=2e-9, rtol=0)
    np.testing.assert_allclose(whole.zmp, states[:, 4], atol=1e-12, rtol=0)


def test_trajectory_is_katayamas_law_written_out() -> None:
    """A double loop over the law in increments, as `preview_gains` states it."""
    design = KAJITA.design
    reference = walk(0.005, 4.0)[:, 1] + 0.02
    n = KAJITA.n_preview
    held = np.append(reference, np.repeat(reference[-1], n))
    x = before = np.array([reference[0], 0.0, 0.0])
    jerk, com = 0.0, []
    for k in range(len(reference)):
        com.append(x[0])
        error = (design.system.C @ x).item() - held[k]
        change = -design.integral_gain.item() * error - design.state_gain[0] @ (x - before)
        for ahead in range(1, n + 1):
            change -= design.preview_gain[ahead - 1, 0, 0] * (held[k + ahead] - held[k + ahead - 1])
        jerk += change
        before, x = x, design.system.A @ x + design.system.B[:, 0] * jerk
    np.testing.assert_allclose(KAJITA.trajectory(reference).com, com, atol=1e-12, rtol=0)


def test_the_labs_call_for_one_axis_and_two() -> None:
    reference = walk(0.01)
    com, velocity = LAB.generate_com_trajectory(reference)
    assert com.shape == velocity.shape == (1001, 2)
    for axis in (0, 1):
        one, speed = LAB.generate_com_trajectory(reference[:, axis])
        assert one.shape == speed.shape == (1001,)
        np.testing.assert_allclose(one, com[:, axis], atol=1e-13)
        np.testing.assert_allclose(speed, velocity[:, axis], atol=1e-12)
    # The CoM ends at rest above the last reference.
    np.testing.assert_allclose(com[-1], reference[-1], atol=1e-3)
    # Velocity and acceleration are the derivatives of the position.
    whole = LAB.trajectory(reference)
    np.testing.assert_allclose(np.gradient(com, 0.01, axis=0)[1:-1], velocity[1:-1], atol=1e-3)
    np.testing.assert_allclose(whole.zmp, com - 0.8 / 9.81 * whole.acceleration, atol=1e-15)


def test_every_form_of_a_start() -> None:
    reference = walk(0.01, 4.0)
    one = reference[:, 1]
    np.testing.assert_array_equal(LAB.trajectory(one).com, LAB.trajectory(one, one[0]).com)
    assert LAB.trajectory(one, 0.03).com[0] == pytest.approx(0.03, abs=1e-15)
    full = LAB.trajectory(one, [0.03, 0.1, -0.2])
    begins = (full.com[0], full.velocity[0], full.acceleration[0])
    np.testing.assert_allclose(begins, (0.03, 0.1, -0.2), atol=1e-14)
    rows = LAB.trajectory(reference, [[0.0, 0.2, 0.1], [0.03, 0.1, -0.2]])
    np.testing.assert_allclose(rows.com[:, 1], full.com, atol=1e-13)
    state = LAB.initial_state((0.0, 0.03), (0.2, 0.1), (0.1, -0.2))
    np.testing.assert_array_equal(LAB.trajectory(reference, state).com, rows.com)
    two = LAB.trajectory(reference, (0.1, 0.2)).com[0]
    np.testing.assert_allclose(two, (0.1, 0.2), atol=1e-15)
    assert LAB.trajectory([0.2]).com.tolist() == [0.2]


def test_a_run_cut_anywhere_goes_on_as_if_uncut() -> None:
    """A state is all the past there is, the jerk standing for the integral of the error."""
    reference = walk(0.005, 6.0)
    whole = KAJITA.trajectory(reference)
    states = run_steps(KAJITA, reference, KAJITA.initial_state(reference[0]))
    for cut in (1, 200, 601):
        rest = KAJITA.trajectory(reference[cut:], ComState(states[cut]))
        np.testing.assert_allclose(rest.com, whole.com[cut:], atol=1e-12)


@given(
    a=st.floats(-2.0, 2.0),
    b=st.floats(-2.0, 2.0),
    seed=st.integers(0, 1000),
)
@settings(max_examples=20)
def test_superposition(a: float, b: float, seed: int) -> None:
    first, second = np.random.default_rng(seed).normal(size=(2, 300)) * 0.1
    x1, x2 = np.random.default_rng(seed + 1).normal(size=(2, 3)) * 0.1
    both = LAB.trajectory(a * first + b * second, a * x1 + b * x2)
    sum_of = a * LAB.trajectory(first, x1).com + b * LAB.trajectory(second, x2).com
    np.testing.assert_allclose(both.com, sum_of, atol=1e-11)


@given(shift=st.integers(1, 400), where=st.floats(-1000.0, 1000.0))
@settings(max_examples=20)
def test_shift_in_time_and_in_space(shift: int, where: float) -> None:
    """At rest nothing happens before the window sees a change, wherever the origin is."""
    reference = np.concatenate([np.zeros(KAJITA.n_preview), walk(0.005, 4.0)[:, 1]])
    later = np.concatenate([np.zeros(shift), reference]) + where
    moved = KAJITA.trajectory(later)
    np.testing.assert_allclose(moved.com[:shift], where, atol=1e-12)
    np.testing.assert_allclose(moved.com[shift:], KAJITA.trajectory(reference).com + where,
                               atol=1e-12 * (1.0 + abs(where)))  # fmt: skip


def test_standing_is_exact_far_from_the_origin() -> None:
    state = LAB.initial_state((1000.0, -500.0))
    window = np.tile(state.com, (LAB.n_preview, 1))
    for _ in range(500):
        state = LAB.step(state, window)
    np.testing.assert_allclose(state.zmp, (1000.0, -500.0), atol=1e-10)


def test_a_plan_changed_under_way_is_followed_without_a_jump() -> None:
    """The reference moves 0.1 m sideways in mid-run: jerk stays bounded, the ZMP gets there."""
    n = KAJITA.n_preview
    state = KAJITA.initial_state((0.0, 0.0))
    jerks = []
    for k in range(900):
        target = np.zeros((n, 2))
        if k >= 100:  # from here on the plan says: at sample 500 the ZMP moves by 0.1 m
            ramp = np.clip((k + 1 + np.arange(n) - 500) / 20, 0.0, 1.0)
            target[:, 1] = 0.1 * ramp
        state = KAJITA.step(state, target)
        jerks.append(state.jerk[1])
    assert np.abs(np.diff(jerks)).max() < 20.0
    np.testing.assert_allclose(state.zmp, (0.0, 0.1), atol=1e-6)


def test_zmp_error_against_horizon() -> None:
    """The lab's walk, z_c 0.814 m, 5 ms: about 20 / 6.2 / 5.5 / 4.3 mm."""
    reference = walk(0.005, stand=2.5)[:, 0]
    errors = []
    for samples in (160, 240, 320, 400):
        zmp = PreviewController(0.814, 0.005, samples * 0.005).trajectory(reference).zmp
        errors.append(1e3 * np.abs(zmp - reference).max())
    np.testing.assert_allclose(errors, [20.0, 6.2, 5.5, 4.3], rtol=0.15)
    # A ZMP that jumps by 0.1 m cannot be followed by a bounded jerk, whatever the horizon.
    jump = np.where(np.arange(2000) < 1000, 0.0, 0.1)
    for samples in (320, 640):
        zmp = PreviewController(0.814, 0.005, samples * 0.005).trajectory(jump).zmp
        assert np.abs(zmp - jump).max() == pytest.approx(0.038, abs=0.001)


def test_a_cheap_jerk_approaches_the_exact_inverse_of_the_pendulum() -> None:
    """Where c - c'' / omega^2 = p for all time, a corner of p adds an exponential to c = p.

    For a change of slope ds at t_i the bounded solution is ds / (2 omega) exp(-omega |t - t_i|).
    """
    omega = natural_frequency(0.814)
    corners, heights = np.array([3.0, 3.1, 3.6, 3.7, 4.2, 4.3]), [0, 0.1, 0.1, -0.1, -0.1, 0]
    t = np.arange(1600) * 0.005
    reference = np.interp(t, corners, heights)
    bends = np.diff(np.diff(heights) / np.diff(corners), prepend=0.0, append=0.0)
    exact = reference + np.exp(-omega * np.abs(t[:, None] - corners)) @ bends / (2 * omega)
    gaps = []
    for r in (1e-6, 1e-8):
        com = PreviewController(0.814, 0.005, 4.0, r=r).trajectory(reference).com
        gaps.append(np.abs(com - exact).max())
    # What is left at last is the jerk being constant over a sample.
    assert gaps[0] < 5e-6
    assert gaps[1] < 2e-6


def test_horizons_shorter_than_two_time_constants_are_warned_of() -> None:
    """What the lab's 1 s neglects is 3 % of the slow mode; 0.2 s would neglect half of it."""
    assert LAB.design.neglected == pytest.approx(np.exp(-natural_frequency(0.8)), rel=1e-3)
    sentence = (
        "a preview horizon of 20 samples (0.2 s) is shorter than 58 samples (0.58 s), 2 time "
        "constants of the closed loop's slow mode (0.286 s)."
    )
    with pytest.warns(ShortHorizonWarning, match=f"^{re.escape(sentence)}$"):
        PreviewController(preview_time=0.2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert PreviewController(preview_time=0.58).n_preview == 58


@given(tau=st.floats(0.0, 0.005))
def test_between_ticks_the_motion_is_the_exact_polynomial(tau: float) -> None:
    state = KAJITA.initial_state((0.1, -0.2), (0.3, 0.1), (1.0, -2.0), (5.0, 6.0))
    following = KAJITA.step(state, np.full((KAJITA.n_preview, 2), 0.05))
    between = KAJITA.interpolate(state, following, tau)
    powers = np.array([1.0, tau, tau**2 / 2, tau**3 / 6])
    start = np.array([state.com, state.velocity, state.acceleration, following.jerk])
    np.testing.assert_allclose(between.com, powers @ start, atol=1e-15)
    np.testing.assert_allclose(between.velocity, powers[:3] @ start[1:], atol=1e-14)
    np.testing.assert_allclose(between.acceleration, powers[:2] @ start[2:], atol=1e-12)
    np.testing.assert_allclose(
        between.zmp, between.com - 0.814 / 9.81 * between.acceleration, atol=1e-14
    )


def test_interpolation_meets_the_ticks() -> None:
    state = KAJITA.initial_state((0.1, -0.2), (0.3, 0.1), (1.0, -2.0))
    following = KAJITA.step(state, np.full((KAJITA.n_preview, 2), 0.05))
    at_start = KAJITA.interpolate(state, following, 0.0).array
    np.testing.assert_array_equal(at_start[:3], state.array[:3])
    at_end = KAJITA.interpolate(state, following, KAJITA.dt).array
    np.testing.assert_allclose(at_end, following.array, rtol=1e-12, atol=1e-14)


def test_values_cannot_be_changed_and_runs_repeat_bit_for_bit() -> None:
    state = LAB.initial_state((0.0, 0.0))
    with pytest.raises(ValueError, match="read-only"):
        state.com[0] = 1.0
    reference = walk(0.01)
    again = PreviewController().trajectory(reference)
    np.testing.assert_array_equal(LAB.trajectory(reference).com, again.com)
    np.testing.assert_allclose(LAB.window_offsets[[0, -1]], [0.01, 1.0])


@pytest.mark.parametrize("copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_copies_are_the_same_controller(copied: Callable[[object], PreviewController]) -> None:
    again = copied(KAJITA)
    reference = walk(0.005, 4.0)
    np.testing.assert_array_equal(again.trajectory(reference).com, KAJITA.trajectory(reference).com)
    state = copied(KAJITA.initial_state((0.1, 0.2)))
    assert not state.array.flags.writeable
    assert not again.window_offsets.flags.writeable
    assert not again.design.riccati.flags.writeable
    assert repr(again) == "PreviewController(z_c=0.814, dt=0.005, n_preview=320)"
    assert repr(state) == "ComState(com [0.1, 0.2] m, velocity [0, 0] m/s, zmp [0.1, 0.2] m)"


def test_importing_the_controller_does_not_load_control() -> None:
    """It costs more than half a second, and a plan that is only read needs no design."""
    code = "import sys, preview_walk.preview.controller; print('control' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
