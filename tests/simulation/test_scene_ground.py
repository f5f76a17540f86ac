"""The ground of scenes that somebody else made: its height is where MuJoCo's rays meet it."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import RobotError
from preview_walk.robots.finding.tree import Tree
from preview_walk.simulation.scene_ground import SceneGround, scene_ground
from preview_walk.types import Foot

MODELS = Path(__file__).parents[2] / "models"

FEET = """
  <body name="left" pos="0 0 50"><freejoint/><geom name="l" size=".1" contype="1"/></body>
  <body name="right" pos="0 3 50"><freejoint/><geom name="r" size=".1" contype="1"/></body>
"""
MESH = """<asset>
<mesh name="wedge" vertex="0 0 0  1 0 0  1 1 0  0 1 0  0 0 .1  1 0 .4  1 1 .4  0 1 .1"/>
<hfield name="hills" nrow="5" ncol="9" size="1 .5 .2 .1" elevation="{}"/></asset>"""
SHAPES = {
    "tilted plane": '<geom type="plane" size="0 0 1" euler="4 -5 20"/>',
    "finite plane": '<geom type="plane" size="0 0 1" pos="0 0 -1"/>'
    '<geom type="plane" size=".5 .3 1" pos=".2 .1 .1" euler="0 8 30"/>',
    "boxes": '<geom type="plane" size="0 0 1"/>'
    '<geom type="box" size=".3 .2 .1" pos=".3 0 .1" euler="0 -10 25"/>'
    '<geom type="box" size=".1 .3 .2" pos="-.4 0 .1" euler="90 0 0"/>'
    '<geom type="box" size=".2 .3 .1" pos="-.4 -.7 .1" euler="0 185 0"/>',
    "mesh": '<geom type="plane" size="0 0 1" pos="0 0 -.2"/>'
    '<geom type="mesh" mesh="wedge" pos="0 0 .1" euler="0 0 40"/>',
    "height field": '<geom type="hfield" hfield="hills" pos=".1 0 0"/>',
    "round": '<geom type="plane" size="0 0 1"/>'
    '<geom type="cylinder" size=".3 .1" pos=".3 .2 0"/>'
    '<geom type="sphere" size=".5"  pos="-.4 0 -.3"/>',
}


def scene(shapes: str) -> Tree:
    heights = " ".join(str(v) for v in np.random.default_rng(0).uniform(0.0, 1.0, 45).round(3))
    geoms = shapes.replace("<geom ", '<geom contype="0" conaffinity="1" ')
    return Tree(
        mujoco.MjModel.from_xml_string(
            f"<mujoco>{MESH.format(heights)}<worldbody>{geoms}{FEET}</worldbody></mujoco>"
        )
    )


def feet_of(tree: Tree) -> dict[int, Foot]:
    return {tree.mj.geom("l").id: "left", tree.mj.geom("r").id: "right"}


@pytest.mark.parametrize("name", SHAPES)
def test_its_height_is_where_rays_meet_it(name: str) -> None:
    tree = scene(SHAPES[name])
    ground, _ = scene_ground(tree, feet_of(tree))
    assert isinstance(ground, SceneGround)
    hit, found = np.zeros(1, np.int32), []
    for x, y in np.random.default_rng(2).uniform((-0.85, -0.48), (0.9, 0.48), (300, 2)):
        above, down = np.array((x, y, 5.0)), np.array((0.0, 0.0, -1.0))
        there = 5.0 - mujoco.mj_ray(tree.mj, tree.data, above, down, None, 1, -1, hit)
        found.append(abs(float(ground.height(x, y)) - there))
    misses = np.array(found)
    # Sides of tilted boxes are left out, a slab tilted both ways is no rectangle from above, and
    # meshes and round shapes are sampled.
    assert (misses < (1e-6 if name not in ("mesh", "round") else 2e-3)).mean() > 0.93
    if name in ("tilted plane", "height field"):
        assert misses.max() < 1e-6


def test_what_cannot_be_stood_on_is_no_ground() -> None:
    for shapes in (
        '<geom type="plane" size="0 0 1" euler="172 0 0"/>',
        '<geom type="plane" size="0 0 1" euler="80 0 0"/>',
        '<body><joint/><geom type="box" size="1 1 1"/></body>',
    ):
        tree = scene(shapes)
        with pytest.raises(RobotError, match="the model has no floor"):
            scene_ground(tree, feet_of(tree))


def lab_scene(*geoms: dict[str, object], tilt: float = 0.0) -> tuple[pw.Scene, pw.Robot]:
    """Return the lab's robot in its own model with more on the floor, which may be tilted."""
    spec = mujoco.MjSpec.from_file(str(MODELS / "humanoid-walker.xml"))
    spec.geom("floor").quat = (np.cos(0.5 * tilt), 0.0, np.sin(0.5 * tilt), 0.0)
    for geom in geoms:
        spec.worldbody.add_geom(contype=0, conaffinity=1, **geom)
    model = spec.compile()
    robot = pw.load_robot(model)
    return pw.Scene(robot, model, mujoco.MjData(model)), robot


def stairs_of(rise: float, tread: float, count: int) -> list[dict[str, object]]:
    return [
        {
            "type": mujoco.mjtGeom.mjGEOM_BOX,
            "size": (0.5 * tread * (count - k) + 0.5, 1.0, 0.5 * rise * (k + 1)),
            "pos": (0.3 + tread * k + 0.5 * tread * (count - k) + 0.5, 0.0, 0.5 * rise * (k + 1)),
        }
        for k in range(count)
    ]


@pytest.mark.parametrize("what", ["stairs", "slope"])
def test_stairs_and_a_slope_in_a_scene_are_walked(what: str) -> None:
    scene, robot = (
        lab_scene(*stairs_of(0.05, 0.3, 4)) if what == "stairs" else lab_scene(tilt=0.0524)
    )
    planner = pw.FootstepPlanner(0.22, robot.step_width, 0.8)
    record = pw.Walk(scene, planner.generate_footsteps(6, ramp=1)).run().record()
    assert not record.run.fell
    # Measured: 0.1 mm and less sideways and ahead, up to 1.7 mm in height.
    assert np.sqrt(((record.com - record.com_ref) ** 2).mean(axis=0)).max() < 3e-3
    for foot in (record.left_foot[-1], record.right_foot[-1]):
        x, y, z = foot[:3, 3]
        assert z == pytest.approx(float(scene.ground.height(x, y)), abs=2e-3)
        assert z > 0.09 if what == "stairs" else z < -0.04
