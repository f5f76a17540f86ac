"""What the preview controller refuses, in which words, and the argument that it names."""

import re
from typing import Any

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.preview.controller import PreviewController

LAB = PreviewController()


def refused(sentence: str) -> pytest.RaisesExc[InvalidInput]:
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def test_refusals() -> None:
    with refused("expected preview_time to be a positive number of s, got -1.0."):
        PreviewController(preview_time=-1.0)
    with refused("expected z_c to be a positive number of m, got 0.0."):
        PreviewController(z_c=0.0)
    with refused("expected R to be positive definite, got a smallest eigenvalue of -1."):
        PreviewController(r=-1.0)
    with refused("expected zmp_ref of shape (N,) or (N, 2) with N >= 1, got (4, 3)."):
        LAB.generate_com_trajectory(np.zeros((4, 3)))
    with refused("expected zmp_ref of shape (N,) or (N, 2) with N >= 1, got (0,)."):
        LAB.trajectory([])
    with refused("expected a finite zmp_ref, got NaN or infinity."):
        LAB.trajectory([0.0, np.nan])
    with refused("expected x0 to be finite and a number or [c, c', c''], got [1, 2]."):
        LAB.trajectory([0.0, 0.0], [1, 2])
    with refused("expected x0 to be finite and of shape (2,) or (2, 3), got 1.0."):
        LAB.trajectory(np.zeros((4, 2)), 1.0)
    with refused("expected a ComState to start a zmp_ref of shape (N, 2), got one axis."):
        LAB.trajectory([0.0], LAB.initial_state((0.0, 0.0)))
    with refused("expected velocity to be two finite numbers, got (0.0, nan)."):
        LAB.initial_state((0.0, 0.0), (0.0, float("nan")))


def test_a_reference_at_another_dt_is_refused() -> None:
    t = np.arange(10)
    LAB.trajectory(np.zeros(10), t=3600.0 + 0.01 * t)
    with refused(
        "expected zmp_ref sampled every 0.01 s, the dt of the controller, got samples 0.005 to "
        "0.005 s apart."
    ):
        LAB.generate_com_trajectory(np.zeros(10), t=0.005 * t)
    with refused("expected t of shape (10,), got (9,)."):
        LAB.trajectory(np.zeros(10), t=0.01 * t[:9])


def test_step_refusals() -> None:
    state = LAB.initial_state((0.0, 0.0))
    following = LAB.step(state, np.zeros((100, 2)))
    with refused("expected zmp_window of shape (100, 2), got (99, 2)."):
        LAB.step(state, np.zeros((99, 2)))
    with refused("expected zmp_window of shape (100, 2), got (100,)."):
        LAB.step(state, np.zeros(100))
    with refused("expected a finite zmp_window, got NaN or infinity."):
        LAB.step(state, np.full((100, 2), np.nan))
    with refused("expected tau to be 0 to 0.01 s, got 0.02."):
        LAB.interpolate(state, following, 0.02)
    with refused("expected tau to be 0 to 0.01 s, got nan."):
        LAB.interpolate(state, following, float("nan"))


@pytest.mark.parametrize(
    ("arguments", "argument"),
    [
        ({"z_c": "high"}, "z_c"),
        ({"dt": None}, "dt"),
        ({"dt": 1e300}, "dt"),
        ({"preview_time": 1e300}, "preview_time"),
        ({"q_e": -1.0}, "q_e"),
        ({"q_e": "much"}, "q_e"),
        ({"q_x": np.ones((2, 2))}, "q_x"),
        ({"r": 0.0}, "r"),
    ],
)
def test_the_argument_at_fault_is_named(arguments: dict[str, Any], argument: str) -> None:
    with pytest.raises(InvalidInput) as caught:
        PreviewController(**arguments)
    assert caught.value.argument == argument
