"""Settings of all tests, and the robots and walks that several of them look at, made once each."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from hypothesis import settings

import preview_walk as pw
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.preview import kept
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot

# Same input, same output: property tests draw the same examples in every run.
settings.register_profile("deterministic", derandomize=True, deadline=None)
settings.load_profile("deterministic")


WALKED_ONCE = ("default_walk", "short_walk", "lab", "copied", "gentle", "fast", "walked")
"""Fixtures that walk for seconds, and are shared: who looks at one is run by one process."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        for name in WALKED_ONCE:
            if name in getattr(item, "fixturenames", ()):
                item.add_marker(pytest.mark.xdist_group(name))


@pytest.fixture(scope="session", autouse=True)
def nothing_kept(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep no Riccati solution from one run of the tests to the next: each is solved here."""
    folder = tmp_path_factory.mktemp("kept")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(kept, "user_cache_path", lambda _: folder)
        yield


@pytest.fixture(scope="session")
def talos() -> Robot:
    return pw.load_robot("talos")


@pytest.fixture(scope="session", params=["talos", "icub", "alexander"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return pw.load_robot(request.param)


@pytest.fixture(scope="session")
def make_walk(talos: Robot) -> Callable[..., pw.Walk]:
    """Return a maker of short walks of TALOS: 0.25 m steps, both feet, contact switches."""

    def make(steps: int = 2, **settings: object) -> pw.Walk:
        plan = pw.FootstepPlanner(0.25, talos.step_width, 0.9).generate_footsteps(steps)
        return pw.Walk(talos, plan, **settings)  # type: ignore[arg-type]

    return make


@pytest.fixture(scope="session")
def short_plan(talos: Robot) -> FootstepPlan:
    """Return five steps like those of the default walk."""
    return pw.FootstepPlanner(0.25, talos.step_width, 0.8).generate_footsteps(5, ramp=1)


@pytest.fixture(scope="session")
def short_walk(talos: Robot, short_plan: FootstepPlan) -> Record:
    return pw.simulate(talos, short_plan)


@pytest.fixture(scope="session")
def default_walk(talos: Robot) -> Record:
    """Return the walk of the bare command: 20 steps of 0.25 m in 0.9 s."""
    planner = pw.FootstepPlanner(0.25, talos.step_width, 0.9)
    return pw.simulate(talos, planner.generate_footsteps(20, ramp=2))
