"""Walks that several tests look at, each simulated once."""

from __future__ import annotations

import pytest

import preview_walk as pw
from preview_walk.planning.footsteps import FootstepPlan
from preview_walk.robots.robot import Robot
from preview_walk.simulation.record import Record


@pytest.fixture(scope="session")
def talos() -> Robot:
    return pw.load_robot("talos")


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
