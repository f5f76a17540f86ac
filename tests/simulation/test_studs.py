"""Soles on a height field feel its triangles, and nothing between them."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
import pytest

from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.simulation.studs import PLANE, STUD
from preview_walk.simulation.walk import Walk
from preview_walk.simulation.world import World
from preview_walk.terrain.height_field import HeightField


@pytest.fixture(scope="module")
def g1() -> Robot:
    return load_robot("g1")


RIDGES = HeightField(0.01 * np.random.default_rng(3).uniform(-1.0, 1.0, (25, 25)), 0.05, -0.6, -0.6)
"""Heights within 1 cm, 5 cm apart."""


def standing(robot: Robot, ground: HeightField) -> World:
    world = World(robot, ground=ground)
    q = robot.posture.copy()
    q[2] += float(ground.heights.max())
    world.place(q, 0.0)
    return world


def planes(world: World) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Return centre of the sphere, point and normal of its plane, by the spheres' names."""
    mujoco.mj_kinematics(world.model, world.data)
    found = {}
    for geom in range(world.model.ngeom):
        name = world.model.geom(geom).name
        if name.startswith(PLANE):
            stud = world.data.geom(name.replace(PLANE, STUD)).xpos
            view = world.data.geom(name)
            found[name] = stud.copy(), view.xpos.copy(), view.xmat.reshape(3, 3)[:, 2].copy()
    return found


@pytest.mark.parametrize("ground", [RIDGES, HeightField(np.zeros((30, 30)), 0.04, -0.6, -0.6)])
def test_each_sphere_has_the_plane_of_the_triangle_under_it(g1: Robot, ground: HeightField) -> None:
    found = planes(standing(g1, ground))
    assert len(found) > 20
    for stud, point, normal in found.values():
        x, y, _ = stud.tolist()
        np.testing.assert_allclose(point, (x, y, float(ground.height(x, y))), atol=1e-9)
        np.testing.assert_allclose(normal, ground.normal(x, y), atol=1e-9)


def test_beside_the_field_it_is_the_floor(g1: Robot) -> None:
    """A field of 4 cm under one foot: the other one's spheres look at the floor 1 m below."""
    field = HeightField(np.zeros((2, 2)), 0.04, 0.0, 0.1)
    for stud, point, normal in planes(standing(g1, field)).values():
        beside = not (0.0 <= stud[0] <= 0.04 and 0.1 <= stud[1] <= 0.14)
        assert point[2] == pytest.approx(field.floor if beside else 0.0)
        if beside:
            np.testing.assert_allclose(normal, (0.0, 0.0, 1.0))


def test_a_level_field_pushes_straight_up_as_the_floor_does(g1: Robot) -> None:
    """MuJoCo's own contacts with a level field point 30 degrees aside."""
    world = standing(g1, HeightField(np.zeros((30, 30)), 0.04, -0.6, -0.6))
    for _ in range(20):
        world.step(np.zeros(len(g1.effort)), 1)
        contacts = world.data.contact[: world.data.ncon]
        assert contacts
        for contact in contacts:
            np.testing.assert_allclose(np.abs(contact.frame[:3]), (0.0, 0.0, 1.0), atol=1e-9)


def test_friction_and_softness_are_those_of_the_soles(g1: Robot) -> None:
    world = World(g1, ground=RIDGES, friction=0.37)
    world.model.geom_solref[:, 0] = 0.031
    world.place(g1.posture, 0.0)
    assert (world.model.pair_friction[:, :2] == 0.37).all()
    assert (world.model.pair_solref[:, 0] == 0.031).all()


def test_a_narrow_sole_walks_over_ridges_it_does_not_see(g1: Robot) -> None:
    """On MuJoCo's own contacts the right sole was held down by the field and rolled by 25 degrees.

    Measured: CoM error 0.1, 0.35, 0.61 mm rms.
    """
    heights = np.random.default_rng(7).uniform(-0.01, 0.01, (14, 9))
    heights[:6] = 0.0
    walk = Walk.standing(g1, ground=HeightField(heights, 0.4, -2.0, -1.6), blind=True)
    walk.command(0.25, 0.0, 0.0)
    walk.run(until=7.0)
    assert not walk.fallen
    assert max(walk.record().summary().com_error_rms) < 1e-3


def test_a_copied_world_goes_on_alike(g1: Robot) -> None:
    one = standing(g1, RIDGES)
    one.step(np.zeros(len(g1.effort)), 5)
    other = copy.deepcopy(one)
    for world in (one, other):
        world.step(np.zeros(len(g1.effort)), 20)
        world.sense()
    assert (one.q == other.q).all()
    assert one.model is not other.model
