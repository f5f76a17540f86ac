"""The bound on pushes: printed tables, limits and simulation of its plans, symmetries, errors."""

import re
import runpy
from dataclasses import replace
from math import cos, exp, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from preview_walk.capturability.bound import (
    PUSH_DURATION,
    Direction,
    PushGait,
    SurvivalPlan,
    largest_impulse,
    survival_plan,
)
from preview_walk.capturability.timing import MOST_STEPS
from preview_walk.errors import InvalidInput
from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.types import Array

BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "push_bound_table.py"
TABLE = runpy.run_path(str(BENCHMARK))
GAITS: dict[str, PushGait] = TABLE["GAITS"]
TALOS, G1 = GAITS["TALOS"], GAITS["G1"]
DIRECTIONS: tuple[Direction, ...] = ("forward", "back", "outward", "inward")
ROWS = [(robot, share) for robot, rows in TABLE["REFERENCE"].items() for share in rows]
# Searched times take a second or two each; the benchmark prints all of them.
TIMED = [
    ("TALOS", 0.3, "forward"),
    ("TALOS", 0.9, "outward"),
    ("TALOS", 0.5, "inward"),
    ("G1", 0.5, "forward"),
    ("G1", None, "back"),
]
PRINTED = 0.06


@pytest.mark.parametrize(("robot", "share"), ROWS)
def test_cop_and_steps_agree_with_the_table_as_printed(robot: str, share: float | None) -> None:
    # zip: standing has one column for both sides.
    for direction, cell in zip(DIRECTIONS, TABLE["REFERENCE"][robot][share], strict=False):
        ours = [largest_impulse(GAITS[robot], share, direction, a) for a in ("cop", "steps")]
        assert ours == pytest.approx(cell[:2], abs=PRINTED), direction


@pytest.mark.parametrize(("robot", "share", "direction"), TIMED)
def test_free_timing_agrees_with_the_table_as_printed(
    robot: str, share: float | None, direction: Direction
) -> None:
    ours = largest_impulse(GAITS[robot], share, direction, "steps_and_timing")
    cell = TABLE["REFERENCE"][robot][share][DIRECTIONS.index(direction)]
    assert ours == pytest.approx(cell[2], abs=PRINTED)


@pytest.mark.parametrize("gait", [TALOS, G1])
def test_standing_cop_bound_is_the_distance_to_the_edge_of_the_support(gait: PushGait) -> None:
    for angle in np.linspace(-pi, pi, 9):
        width = gait.sole.half_width + 0.5 * gait.step_width
        edges = [gait.sole.half_length / max(abs(cos(angle)), 1e-9)]
        edges.append(width / max(abs(sin(angle)), 1e-9))
        expected = gait.impulse(min(edges), PUSH_DURATION)
        assert largest_impulse(gait, None, angle, "cop") == pytest.approx(expected, rel=1e-6)


def supports(plan: SurvivalPlan) -> list[tuple[float, float, Array]]:
    """Return begin, end and standing soles of every phase of a plan."""
    phases = [(0.0, plan.lifts[0] if len(plan.lifts) else 1.0, plan.soles[:2])]
    for k in range(len(plan.lands)):
        phases.append((plan.lifts[k], plan.lands[k], plan.soles[k + 1 : k + 2]))
        end = plan.lifts[k + 1] if k + 1 < len(plan.lifts) else plan.lands[k] + 1.0
        phases.append((plan.lands[k], end, plan.soles[k + 1 : k + 3]))
    return phases


@pytest.mark.parametrize("gait", [TALOS, G1])
@pytest.mark.parametrize(
    ("share", "degrees", "answer"),
    [
        (0.3, 45, "cop"),
        (0.7, -60, "steps"),
        (0.9, 0, "steps_and_timing"),
        (0.1, -35, "steps_and_timing"),
        (None, 100, "cop"),
        (None, 30, "steps"),
    ],
)
def test_plan_survives_its_push_in_a_simulation(
    gait: PushGait, share: float | None, degrees: float, answer: Any
) -> None:
    """Within every limit, and the DCM comes to rest in the support.

    The DCM runs away forwards in time but not backwards: from rest at the end, through the push,
    it must come from where it was before.
    """
    plan = survival_plan(gait, share, radians(degrees), answer)
    force = plan.impulse / PUSH_DURATION * plan.direction
    dcm, dt = plan.cops[-1], 1e-4
    for (begin, end, soles), cop in reversed(list(zip(supports(plan), plan.cops, strict=True))):
        poses = np.tile(np.eye(4), (len(soles), 1, 1))
        poses[:, :2, 3] = soles
        if end > begin:
            polygon = support_polygon(list(poses), gait.sole)
            assert support_margin(polygon, cop) > -1e-6
        count = max(1, round((end - begin) / dt))
        step = (end - begin) / count
        for time in end - (np.arange(count) + 0.5) * step:
            push = force / (gait.mass * gait.omega**2) if time < PUSH_DURATION else np.zeros(2)
            rest = cop - push
            dcm = rest + (dcm - rest) * exp(-gait.omega * step)
    size = plan.impulse / (gait.mass * gait.omega)
    np.testing.assert_allclose(dcm, plan.dcm, atol=2e-3 * size)

    if answer == "cop":
        return
    swings = plan.lands - plan.lifts
    aloft = swings.copy()
    aloft[0] += gait.single_support * (share or 0.0)
    assert len(swings) <= MOST_STEPS
    assert np.all((aloft > gait.min_swing_time - 1e-9) & (aloft < gait.max_swing_time + 1e-9))
    travel = np.linalg.norm(plan.soles[2:] - plan.soles[:-2], axis=1)
    assert np.all(travel <= gait.swing_speed * swings + 1e-4)
    strides = np.diff(plan.soles, axis=0)[1:]
    side = np.sign(plan.soles[0, 1] - plan.soles[1, 1]) * (-1.0) ** np.arange(len(strides))
    assert np.all(strides[:, 0] < gait.forward + 1e-4)
    assert np.all(strides[:, 0] > -gait.backward - 1e-4)
    assert np.all(side * strides[:, 1] > gait.min_width - 1e-4)
    assert np.all(side * strides[:, 1] < gait.max_width + 1e-4)


@pytest.mark.parametrize(("share", "degrees"), [(0.2, 70), (1.0, -100)])
def test_more_freedom_never_gives_less(share: float | None, degrees: float) -> None:
    bounds = [
        largest_impulse(G1, share, radians(degrees), answer)
        for answer in ("cop", "steps", "steps_and_timing")
    ]
    assert bounds == sorted(bounds)
    assert bounds[0] > 0.0


def test_a_foot_too_slow_for_its_plan_still_has_the_bound_of_the_plan() -> None:
    """CoP alone keeps the plan and does not ask how fast the foot is."""
    slow = replace(G1, swing_speed=0.1)
    cases: list[tuple[float, Direction]] = [(0.2, "forward"), (0.9, "inward")]
    for share, direction in cases:
        plan_kept, steps = (largest_impulse(slow, share, direction, a) for a in ("cop", "steps"))
        assert steps >= plan_kept == largest_impulse(G1, share, direction, "cop") > 0.0


def test_standing_both_sides_are_the_same() -> None:
    for degrees in (20.0, 150.0):
        plans = [survival_plan(G1, None, radians(sign * degrees), "steps") for sign in (1, -1)]
        assert plans[0].impulse == pytest.approx(plans[1].impulse, rel=1e-6)
    assert largest_impulse(TALOS, None, "outward", "steps") == pytest.approx(
        largest_impulse(TALOS, None, "inward", "steps"), rel=1e-6
    )


def test_walking_backwards_is_the_mirror_image_of_walking_forwards() -> None:
    back = replace(TALOS, step_length=-0.2, forward=TALOS.backward, backward=TALOS.forward)
    for share in (0.3, 0.9):
        for degrees in (0.0, 40.0, -90.0):
            ours = largest_impulse(TALOS, share, radians(degrees), "steps")
            mirrored = largest_impulse(back, share, radians(180.0 - degrees), "steps")
            assert ours == pytest.approx(mirrored, rel=1e-6)


def test_same_input_same_output() -> None:
    calls = [largest_impulse(G1, 0.6, 2.0, "steps_and_timing") for _ in range(2)]
    assert calls[0] == calls[1]


def test_without_double_support() -> None:
    gait = replace(TALOS, double_support=0.0)
    plan = survival_plan(gait, 0.5, "forward", "steps")
    assert plan.impulse > largest_impulse(gait, 0.5, "forward", "cop") > 0.0
    np.testing.assert_allclose(plan.lifts[1:], plan.lands[:-1])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: largest_impulse(TALOS, 1.2, "back", "cop"),
            "share must be between 0 and 1 of single support, or None for standing, got 1.2.",
        ),
        (
            lambda: largest_impulse(TALOS, 0.5, "left", "cop"),  # type: ignore[arg-type]
            "direction must be one of forward, outward, back, inward or a finite angle in rad, "
            "got 'left'.",
        ),
        (
            lambda: largest_impulse(TALOS, 0.5, float("nan"), "cop"),
            "direction must be one of forward, outward, back, inward or a finite angle in rad, "
            "got nan.",
        ),
        (
            lambda: largest_impulse(TALOS, 0.5, 0.0, "arms"),  # type: ignore[arg-type]
            "answer must be one of cop, steps, steps_and_timing, got 'arms'.",
        ),
        (
            lambda: replace(TALOS, mass=0.0),
            "mass must be > 0 kg, got 0.0.",
        ),
        (
            lambda: replace(TALOS, double_support=-0.1),
            "double_support must be >= 0 s, got -0.1.",
        ),
        (
            lambda: replace(TALOS, step_length=0.7),
            "step_length must be between -0.4 and 0.6, the limits of a step, got 0.7.",
        ),
        (
            lambda: replace(TALOS, step_width=0.1),
            "step_width must be between 0.14 and 0.55, the limits of a step, got 0.1.",
        ),
    ],
)
def test_bad_input_is_named(call: Any, message: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(message)}$") as caught:
        call()
    assert caught.value.argument == message.split()[0]


@pytest.mark.parametrize("value", ["text", None, 1j, [1.0], np.ones(2), 1e308, np.nan, 10**400])
@pytest.mark.parametrize("name", [*TALOS.__dataclass_fields__])
def test_a_gait_of_anything_but_numbers_is_refused(name: str, value: Any) -> None:
    if value is None and name == "short_double_support":
        return
    with pytest.raises(InvalidInput) as caught:
        replace(TALOS, **{name: value})
    assert caught.value.argument == name


def test_wider_limits_give_a_larger_bound() -> None:
    wide = replace(TALOS, max_width=0.7, forward=0.7, backward=0.5)
    for direction in DIRECTIONS:
        there = largest_impulse(wide, 0.5, direction, "steps")
        assert there >= largest_impulse(TALOS, 0.5, direction, "steps") - 1e-6
    assert largest_impulse(wide, 0.5, "inward", "steps") > 1.05 * largest_impulse(
        TALOS, 0.5, "inward", "steps"
    )


def test_a_short_double_support_serves_free_times_only() -> None:
    quick = replace(TALOS, short_double_support=0.035)
    for answer in ("cop", "steps"):
        assert largest_impulse(quick, 0.5, "forward", answer) == largest_impulse(
            TALOS, 0.5, "forward", answer
        )
    plan = survival_plan(quick, 0.5, "forward", "steps_and_timing")
    assert plan.lifts[1:] - plan.lands[:-1] == pytest.approx(0.035)


def test_the_controllers_own_limits_are_those_it_steps_by() -> None:
    own = TABLE["own_limits"]("TALOS")
    assert own.max_width == pytest.approx(0.698, abs=1e-3)
    assert own.min_swing_time == pytest.approx(0.316, abs=1e-3)
    assert (own.mass, own.com_height, own.sole) == (TALOS.mass, TALOS.com_height, TALOS.sole)
    assert own.forward > TALOS.step_length
