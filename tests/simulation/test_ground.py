"""Walks on ground that is not flat: soles on it, the CoM on its reference."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.simulation.world import World
from preview_walk.terrain.ground import Ground
from preview_walk.terrain.shapes import path, slope, stairs
from preview_walk.types import Array


def walked(robot: Robot, ground: Ground | None, steps: int = 6) -> pw.Record:
    planner = pw.FootstepPlanner(0.25, robot.step_width, 0.9)
    return pw.simulate(robot, planner.generate_footsteps(steps, ramp=1), ground=ground)


def test_level_slabs_are_walked_as_the_floor_is(talos: Robot) -> None:
    """The same walk to what another arrangement of contacts changes: microns."""
    flat, slabs = walked(talos, None, 3), walked(talos, path([]), 3)
    assert len(flat) == len(slabs)
    assert slabs.com == pytest.approx(flat.com, abs=2e-5)


@pytest.mark.parametrize("degrees", [8.0, -8.0])
def test_a_slope_is_walked_with_its_tilt_under_the_soles(talos: Robot, degrees: float) -> None:
    ground = slope(degrees)
    record = walked(talos, ground, 8)
    assert not record.run.fell
    # Measured: 0.06 mm on every axis, up and down.
    error = record.com - record.com_ref
    assert np.sqrt((error**2).mean(axis=0)).max() < 2e-4
    for foot in ("left", "right"):
        pose, force = getattr(record, f"{foot}_foot"), getattr(record, f"{foot}_force")
        stands = force[:, 2] > 0.5 * talos.mass * 9.81
        x, y, z = pose[stands, :3, 3].T
        # MuJoCo's contacts give way by 0.4 mm on the level, by up to 2.8 mm where an edge carries.
        assert np.abs(z - ground.height(x, y)).max() < 3.5e-3
    assert record.left_foot[-1, :3, 2] == pytest.approx(ground.normal(3.0, 0.0), abs=0.01)


def test_a_worlds_ground_is_where_its_value_says(talos: Robot) -> None:
    """Rays from above meet the geoms at the heights of the value, on planes and edges alike."""
    ground = stairs(0.12, 0.3, 4)
    world = World(talos, ground=ground)
    world.place(np.array(talos.posture) + np.eye(talos.pin.nq)[2] * 20.0, 0.0)
    for x, y in np.random.default_rng(3).uniform((-1.0, -1.2), (3.0, 1.2), (60, 2)):
        assert hit(world, x, y) == pytest.approx(float(ground.height(x, y)), abs=1e-6)


def hit(world: World, x: float, y: float) -> float:
    """Return the height (m) of whatever a ray from 5 m above meets first."""
    start: Array = np.array((x, y, 5.0))
    geom = np.zeros(1, dtype=np.int32)
    down = np.array((0.0, 0.0, -1.0))
    return 5.0 - mujoco.mj_ray(world.model, world.data, start, down, None, 1, -1, geom)


def test_another_kind_of_ground_is_refused(talos: Robot) -> None:
    with pytest.raises(
        InvalidInput, match=r"^ground must be a FlatGround, a SlabGround or a HeightField"
    ) as told:
        World(talos, ground="stairs")  # type: ignore[arg-type]
    assert told.value.argument == "ground"
