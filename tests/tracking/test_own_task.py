"""A task of one's own in the QP of every tick."""

import re
from collections.abc import Callable

import numpy as np
import pytest
from tracking.states import full_load, standing_controller

from preview_walk import Walk
from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import Array

MakeWalk = Callable[..., Walk]


class HoldHand:
    """A task of one's own: a hand stays where it is in the world."""

    rows = 3
    weight = 10.0

    def __init__(self, body: WholeBodyController) -> None:
        self.hand = body.dynamics.frame("arm_right_7_link")
        self.goal = self.hand.position.copy()

    def update(self, dynamics: object, jacobian: Array, target: Array) -> None:
        hand = self.hand
        jacobian[:] = hand.rotation @ hand.jacobian[:3]
        target[:] = 100.0 * (self.goal - hand.position)
        target -= hand.rotation @ (20.0 * hand.velocity[:3] + hand.drift[:3])


def test_a_task_of_ones_own(make_walk: MakeWalk) -> None:
    errors = []
    for own in (True, False):
        walk = make_walk(1)
        body = walk.walker.body
        hold = HoldHand(body)
        if own:
            body.torques(full_load(walk.robot))  # also after the first tick
            body.add_task(hold)
        walk.run(until=1.5)  # the CoM shifts over the stance foot
        errors.append(float(np.linalg.norm(hold.hand.position - hold.goal)))
    assert errors[0] < 0.01 < errors[1]


@pytest.mark.parametrize(("rows", "weight"), [(0, 1.0), (3, 0.0), (3, -1.0), (3, np.inf)])
def test_a_task_that_cannot_be(talos: Robot, rows: int, weight: float) -> None:
    class Odd(HoldHand):
        pass

    body = standing_controller(talos)
    odd = Odd(body)
    odd.rows, odd.weight = rows, weight
    said = f"a task must have rows >= 1 and a weight > 0, got rows = {rows} and weight = {weight}."
    with pytest.raises(InvalidInput, match=re.escape(said)):
        body.add_task(odd)
