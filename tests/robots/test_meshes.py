"""Mesh files: found, read with their colours, or left out."""

import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from preview_walk.robots.load import load_robot, visual_model
from preview_walk.robots.reading.description import example_robot_data
from preview_walk.robots.reading.meshes import mesh_file, read_mesh
from preview_walk.robots.reading.shapes import VISUAL_GROUP


@pytest.fixture
def square():
    return np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)


def write_stl(path: Path, corners) -> None:
    triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    record = np.zeros(4, dtype=[("n", "<f4", 3), ("c", "<f4", (3, 3)), ("s", "<u2")])
    record["c"] = [[corners[i] for i in triangle] for triangle in triangles]
    path.write_bytes(b"\0" * 80 + (4).to_bytes(4, "little") + record.tobytes())


def collada(up_axis: str, meter: float) -> str:
    """A triangle (0 0 0), (1 0 0), (0 1 0) and its tip (0 0 1), red."""
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{meter}"/><up_axis>{up_axis}</up_axis></asset>
<library_effects><effect id="red"><profile_COMMON><technique sid="common"><phong>
<diffuse><color>1 0 0 1</color></diffuse></phong></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="redm"><instance_effect url="#red"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#redm"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def test_binary_stl(tmp_path, square):
    write_stl(tmp_path / "a.STL", square)
    (piece,) = read_mesh(tmp_path / "a.STL")
    assert {tuple(v) for v in piece.vertices} == {tuple(v) for v in square}
    assert piece.faces.shape == (4, 3)
    assert piece.rgba is None


@pytest.mark.parametrize(
    ("up_axis", "meter", "tip"),
    [("Z_UP", 1.0, (0, 0, 1)), ("Y_UP", 1.0, (0, -1, 0)), ("Z_UP", 0.001, (0, 0, 0.001))],
)
def test_collada_ends_up_in_metres_with_z_up(tmp_path, up_axis, meter, tip):
    pytest.importorskip("collada")
    (tmp_path / "a.dae").write_text(collada(up_axis, meter))
    (piece,) = read_mesh(tmp_path / "a.dae")
    assert piece.rgba == (1.0, 0.0, 0.0, 1.0)
    assert np.linalg.norm(piece.vertices - tip, axis=1).min() < 1e-9


def test_unreadable_files_are_left_out(tmp_path):
    (tmp_path / "a.stl").write_text("nothing")
    (tmp_path / "b.dae").write_text("nothing")
    assert read_mesh(tmp_path / "a.stl") == []
    assert read_mesh(tmp_path / "b.dae") == []


def test_package_addresses(tmp_path):
    urdf = tmp_path / "walker_description" / "urdf" / "walker.urdf"
    mesh = tmp_path / "walker_description" / "meshes" / "foot.stl"
    for file in (urdf, mesh):
        file.parent.mkdir(parents=True)
        file.touch()
    for address in (
        "package://walker_description/meshes/foot.stl",
        "package://renamed_package/meshes/foot.stl",
        "../meshes/foot.stl",
        f"file://{mesh}",
    ):
        assert mesh_file(address, urdf).resolve() == mesh
    assert mesh_file("package://walker_description/meshes/hand.stl", urdf) is None


@pytest.mark.parametrize("name", ["alexander", "icub", "romeo", "talos"])
def test_robots_are_shown_in_their_own_meshes(name):
    robot = load_robot(name)
    seen = visual_model(robot)
    meshes = (seen.geom_type == mujoco.mjtGeom.mjGEOM_MESH).sum()
    assert meshes >= 12
    assert (seen.nq, seen.nv, seen.nu) == (robot.mj.nq, robot.mj.nv, robot.mj.nu)
    np.testing.assert_array_equal(seen.body_mass, robot.mj.body_mass)
    # As large as the robot: units and axes are right.
    data = mujoco.MjData(seen)
    mujoco.mj_kinematics(seen, data)
    shown = seen.geom_group == VISUAL_GROUP
    height = np.ptp(data.geom_xpos[shown, 2])
    assert 0.8 * robot.com_height < height < 2.5 * robot.com_height


def test_dae_robots_load_without_trimesh(monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    icub = visual_model(load_robot("icub"))
    assert not (icub.geom_type == mujoco.mjtGeom.mjGEOM_MESH).any()
    assert (icub.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE).any()  # bones instead
    talos = visual_model(load_robot("talos"))
    assert (talos.geom_type == mujoco.mjtGeom.mjGEOM_MESH).any()  # STL needs no library


def test_the_catalogues_files_are_there():
    assert (example_robot_data() / "talos_data").is_dir()
