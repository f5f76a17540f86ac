"""What makes another way of writing a robot the same robot, for what a walk depends on."""

import numpy as np
import pytest

from preview_walk.types import FEET


def same_walk(robot, original):
    """Same legs, same stance: nothing that the walk depends on has changed."""
    assert robot.com_height == pytest.approx(original.com_height, abs=1e-8)
    assert robot.leg_length == pytest.approx(original.leg_length)
    assert robot.mass == pytest.approx(original.mass)
    np.testing.assert_allclose(robot.posture[7:], original.posture[7:], atol=1e-8)
    np.testing.assert_allclose(robot.effort, original.effort)
    for foot in FEET:
        one, two = robot.soles[foot], original.soles[foot]
        assert (one.half_length, one.half_width) == pytest.approx((two.half_length, two.half_width))
