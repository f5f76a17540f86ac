"""The scene's nodes: every body where MuJoCo has it, every shape of the ground as it is."""

from __future__ import annotations

import io
from typing import Any

import mujoco
import numpy as np
import pytest
import trimesh

import preview_walk as pw
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web.nodes import HIDDEN_GROUP, ROOT, BodyNodes
from preview_walk.viewer.web.stage import Stage, stage_on


def nodes_of(server: Any) -> dict[str, Any]:
    """Return the messages that make the nodes of a page's scene, by the nodes' names."""
    buffer = server._websock_server._broadcast_buffer
    made = [m for m in buffer.message_from_id.values() if m.lifecycle_phase == "create"]
    return {m.name: m for m in made if getattr(m, "name", "").startswith(ROOT)}


def triangles(message: Any) -> Any:
    """Return the mesh that a node sends."""
    return trimesh.load(io.BytesIO(message.props.glb_data), file_type="glb", force="mesh")


def test_bodies_are_where_mujoco_has_them(server: Any, talos: Robot) -> None:
    stage = stage_on(talos, pw.stairs(0.15, 0.28, 3))
    nodes = BodyNodes(server.scene, stage.model)
    random = np.random.default_rng(1)
    for _ in range(3):
        qpos = random.normal(size=stage.model.nq)
        qpos[3:7] /= np.linalg.norm(qpos[3:7])
        stage.set(qpos)
        nodes.update(stage.data)
        data = mujoco.MjData(stage.model)
        data.qpos[:] = qpos
        mujoco.mj_forward(stage.model, data)
        assert len(nodes.frames) > 30
        for body, frame in nodes.frames.items():
            np.testing.assert_allclose(frame.position, data.xpos[body], atol=1e-6)
            np.testing.assert_allclose(frame.wxyz, data.xquat[body], atol=1e-6)


def test_every_mesh_is_sent_once_in_its_body(server: Any, talos: Robot) -> None:
    """Faces and extent of a body's meshes are those of its geoms, in the body's frame."""
    stage = stage_on(talos, pw.FlatGround())
    nodes = BodyNodes(server.scene, stage.model)
    model, sent = stage.model, nodes_of(server)
    meshes = {name: triangles(m) for name, m in sent.items() if "/mesh_" in name}
    assert not any("sole" in name for name in meshes)  # the soles' boxes are for contacts alone
    compared = 0
    for body in nodes.frames:
        geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body]
        geoms = [g for g in geoms if model.geom_group[g] < HIDDEN_GROUP]
        if any(model.geom_type[g] != mujoco.mjtGeom.mjGEOM_MESH for g in geoms):
            continue
        (name,) = (name for name in meshes if name.split("/")[2].endswith(f"_{body}"))
        faces = sum(int(model.mesh_facenum[model.geom_dataid[g]]) for g in geoms)
        assert len(meshes[name].faces) == faces
        points = np.concatenate([_vertices(model, g) for g in geoms])
        bounds = points.min(axis=0), points.max(axis=0)
        np.testing.assert_allclose(meshes[name].bounds, bounds, atol=1e-5)
        compared += 1
    assert compared > 20


def _vertices(model: mujoco.MjModel, geom: int) -> Any:
    """Return the vertices (n, 3) of a geom's mesh in the frame of its body."""
    mesh, turn = model.geom_dataid[geom], np.zeros(9)
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
    return model.mesh_vert[first : first + count] @ turn.reshape(3, 3).T + model.geom_pos[geom]


@pytest.mark.parametrize("words", ["stairs:rise=0.12,tread=0.3,count=3", "slope:degrees=8"])
def test_the_ground_is_drawn_where_it_is_walked_on(server: Any, talos: Robot, words: str) -> None:
    """Seen from above, the drawn ground has the height that the steps are laid on."""
    ground = pw.read_ground(words)
    BodyNodes(server.scene, stage_on(talos, ground).model)
    drawn = [m for name, m in nodes_of(server).items() if "world_0/mesh_" in name]
    mesh = trimesh.util.concatenate([triangles(message) for message in drawn])
    for x in np.linspace(-0.9, 2.5, 25):
        if abs(height := float(ground.height(x, 0.1))) > 1e-9 or x < 1.0:
            assert _above(mesh, x, 0.1) == pytest.approx(height, abs=1e-5)


def test_a_height_field_is_drawn_where_it_is_walked_on(server: Any, talos: Robot) -> None:
    ground = pw.rough(0.06, seed=3)
    BodyNodes(server.scene, stage_on(talos, ground).model)
    (name,) = (name for name in nodes_of(server) if "world_0/mesh_" in name)
    mesh = triangles(nodes_of(server)[name])
    for x, y in ((0.3, 0.1), (1.0, -0.2), (2.2, 0.4)):
        assert _above(mesh, x, y) == pytest.approx(float(ground.height(x, y)), abs=5e-3)


def _above(mesh: Any, x: float, y: float) -> float:
    """Return the height of the highest face at a place."""
    corners = mesh.vertices[mesh.faces]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    det = (b - a)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (b - a)[:, 1]
    a, b, c, det = (part[np.abs(det) > 1e-12] for part in (a, b, c, det))  # no upright faces
    u = ((x - a[:, 0]) * (c - a)[:, 1] - (c - a)[:, 0] * (y - a[:, 1])) / det
    v = ((b - a)[:, 0] * (y - a[:, 1]) - (x - a[:, 0]) * (b - a)[:, 1]) / det
    within = (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1.0 + 1e-6)
    heights = a[:, 2] + u * (b - a)[:, 2] + v * (c - a)[:, 2]
    return float(heights[within].max())


def test_a_plane_is_a_grid_at_its_height(server: Any) -> None:
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody>
        <geom type="plane" size="0 0 1" pos="0 0 -0.3"/>
        <geom type="plane" size="2 3 1" pos="1 0 0.5" euler="0 20 0"/>
        <body name="a/b" pos="0 0 1"><freejoint/><geom type="box" size=".1 .2 .3"/></body>
        </worldbody></mujoco>"""
    )
    nodes = BodyNodes(server.scene, model)
    sent = nodes_of(server)
    endless, small = sent[f"{ROOT}/world_0/plane_0"], sent[f"{ROOT}/world_0/plane_1"]
    assert endless.props.infinite_grid
    assert (small.props.width, small.props.height) == (4.0, 6.0)
    assert not small.props.infinite_grid
    assert list(nodes.frames) == [1]
    box = triangles(sent[f"{ROOT}/a_b_1/mesh_0"])
    np.testing.assert_allclose(box.bounds, [[-0.1, -0.2, -0.3], [0.1, 0.2, 0.3]], atol=1e-6)
    stage = Stage(model, 1)
    stage.set(np.array([1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0]))
    nodes.update(stage.data)
    np.testing.assert_allclose(nodes.frames[1].position, [1.0, 2.0, 3.0])
