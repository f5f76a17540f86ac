"""Pushes at given times: closed forms, brute force, similarity; and the nominal gait."""

import runpy
from dataclasses import replace
from math import atan2, cos, exp, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.capturability.bound import PUSH_DURATION, largest_impulse
from preview_walk.capturability.gait import PushGait
from preview_walk.capturability.timing import MOST_STEPS, PushCase
from preview_walk.types import Array

BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "push_bound_table.py"
GAITS: dict[str, PushGait] = runpy.run_path(str(BENCHMARK))["GAITS"]
TALOS, G1 = GAITS["TALOS"], GAITS["G1"]


def unit(angle: float) -> Array:
    return np.array([cos(angle), sin(angle)])


@pytest.mark.parametrize("gait", [TALOS, G1])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_nominal_dcm_repeats_after_one_step(gait: PushGait, share: float) -> None:
    """Simulated with the CoP in the middle of the sole, then moving to the next one."""
    steps, stride = 20000, gait.step(0)
    dt = (gait.single_support + gait.double_support) / steps
    landing = (1.0 - share) * gait.single_support
    dcm = gait.dcm(share)
    for time in (np.arange(steps) + 0.5) * dt:
        cop = np.clip((time - landing) / gait.double_support, 0.0, 1.0) * stride
        dcm = cop + (dcm - cop) * exp(gait.omega * dt)
    expected = stride + gait.dcm(share) * [1.0, -1.0]
    np.testing.assert_allclose(dcm, expected, atol=1e-5)


@pytest.mark.parametrize("gait", [TALOS, G1])
def test_one_step_bound_in_closed_form(gait: PushGait) -> None:
    """Forward the foot lands at full reach with the CoP at the toes throughout.

    Sideways out the foot cannot help, so the CoP stays at the outer edge; sideways in the foot
    lands as wide as may be with the CoP at the inner edge (Koolen et al. 2012, section 4).
    """
    for share in (0.1, 0.5, 0.7):
        left = (1.0 - share) * gait.single_support
        landing = exp(-gait.omega * left)
        x, y = gait.dcm(share)
        a, b = gait.sole.half_length, gait.sole.half_width
        for angle, jump in (
            (0.0, a + landing * gait.forward - x),
            (pi, a + landing * gait.backward + x),
            (pi / 2, b - y),
            (-pi / 2, b + landing * gait.max_width + y),
        ):
            timed = PushCase(gait, share, unit(angle)).at(0.0, (left,))
            assert timed is not None
            # G1 goes back without room to spare sideways: less than the sagittal closed form.
            if angle == pi and gait is G1:
                assert timed.capture.jump <= jump + 1e-9
            else:
                assert timed.capture.jump == pytest.approx(jump, abs=2e-4)


@settings(max_examples=60)
@given(seed=st.integers(0, 10**6), share=st.floats(0.0, 1.0), talos=st.booleans())
def test_no_random_plan_beats_the_bound_at_its_times(seed: int, share: float, talos: bool) -> None:
    """Any footholds and any CoP in the support capture some DCM: a push within the bound."""
    gait, rng = TALOS if talos else G1, np.random.default_rng(seed)
    count = int(rng.integers(1, MOST_STEPS + 1))
    over = share * gait.single_support
    singles = rng.uniform(gait.min_swing_time, gait.max_swing_time, count)
    singles[0] = rng.uniform(max(0.0, gait.min_swing_time - over), gait.max_swing_time - over)
    size = np.array([gait.sole.half_length, gait.sole.half_width])

    def corner() -> Array:
        # Edges more often than not: that is where the bound is.
        point: Array = np.clip(rng.uniform(-2.0, 2.0, 2), -1.0, 1.0) * size
        return point

    stance, behind = np.zeros(2), gait.swing_foot(share)
    time, dcm = 0.0, np.zeros(2)
    for k, single in enumerate(singles):
        side = -1.0 if k % 2 == 0 else 1.0
        # As fast as the swing may be in the polygon inscribed in the disc of its travel, or slower.
        radius = 0.995 * gait.swing_speed * single
        while True:
            place = np.array(
                [
                    rng.uniform(-gait.backward, gait.forward) + stance[0],
                    side * rng.uniform(gait.min_width, gait.max_width) + stance[1],
                ]
            )
            if np.hypot(*(place - behind)) <= radius:
                break
        last = k == count - 1
        after = 1e3 if last else gait.double_support
        dcm = dcm + (exp(-gait.omega * time) - exp(-gait.omega * (time + single))) * (
            stance + corner()
        )
        time += single
        share_ahead = rng.uniform(0.0, 1.0)
        cop = (1.0 - share_ahead) * (stance + corner()) + share_ahead * (place + corner())
        dcm = dcm + (exp(-gait.omega * time) - exp(-gait.omega * (time + after))) * cop
        time += after
        stance, behind = place, stance
    push = dcm - gait.dcm(share)
    timed = PushCase(gait, share, unit(atan2(push[1], push[0]))).at(0.0, singles.tolist())
    assert timed is not None
    assert timed.capture.jump >= np.hypot(*push) * (1.0 - 1e-3)


@pytest.mark.parametrize(("share", "degrees"), [(0.1, -90), (0.9, 150)])
def test_no_random_times_beat_the_searched_ones(share: float, degrees: float) -> None:
    gait, rng = G1, np.random.default_rng(7)
    bound = largest_impulse(gait, share, radians(degrees), "steps_and_timing")
    case, over = PushCase(gait, share, unit(radians(degrees))), share * gait.single_support
    for _ in range(60):
        first = rng.uniform(max(0.0, gait.min_swing_time - over), 0.6 * gait.max_swing_time)
        later = rng.uniform(gait.min_swing_time, 1.5 * gait.min_swing_time, rng.integers(0, 4))
        timed = case.at(0.0, [float(first), *later.tolist()])
        if timed is not None:
            assert gait.impulse(timed.capture.jump, PUSH_DURATION) <= bound * (1.0 + 1e-3)


def test_the_jump_scales_with_the_size_of_the_pendulum() -> None:
    """Lengths by s, times by the square root of s, the speed of a foot too: jumps by s."""
    scale = 1.7
    lengths = ["com_height", "step_width", "step_length", "forward", "backward", "min_width"]
    lengths += ["max_width"]
    times = ["single_support", "double_support", "min_swing_time", "max_swing_time"]
    speeds = ["swing_speed"]
    changes: dict[str, Any] = {name: getattr(G1, name) * scale for name in lengths}
    changes |= {name: getattr(G1, name) * scale**0.5 for name in times + speeds}
    changes["sole"] = replace(
        G1.sole,
        half_length=G1.sole.half_length * scale,
        half_width=G1.sole.half_width * scale,
    )
    for degrees in (10.0, -80.0, 190.0):
        small, large = (
            PushCase(gait, 0.8, unit(radians(degrees))).by_steps()
            for gait in (G1, replace(G1, **changes))
        )
        assert small is not None
        assert large is not None
        assert large.capture.jump == pytest.approx(scale * small.capture.jump, rel=1e-5)
