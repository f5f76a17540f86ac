"""Robots and walks shared by the tests of the tracking room."""

from collections.abc import Callable

import pytest
from tracking.states import FRICTION

from preview_walk import FootstepPlanner, Walk, load_robot
from preview_walk.robots.robot import Robot


@pytest.fixture(scope="session")
def talos() -> Robot:
    return load_robot("talos")


@pytest.fixture(scope="session", params=["talos", "icub", "alexander"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


@pytest.fixture(scope="session")
def make_walk(talos: Robot) -> Callable[..., Walk]:
    """Return a maker of short walks of TALOS: 0.25 m steps, both feet, contact switches."""

    def make(steps: int = 2, **settings: object) -> Walk:
        plan = FootstepPlanner(0.25, talos.step_width, 0.9).generate_footsteps(steps)
        return Walk(talos, plan, friction=FRICTION, **settings)  # type: ignore[arg-type]

    return make
