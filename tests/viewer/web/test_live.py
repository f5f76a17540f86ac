"""A live walk by its page's controls, without a browser: the handles stand for the visitor."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest
from page_handles import click, handle

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.robots.load import spec_of
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web import live
from preview_walk.viewer.web.live import LiveWalk, run_live
from preview_walk.viewer.web.picture import PICTURES
from preview_walk.viewer.web.stage import configuration
from preview_walk.viewer.web.traces import POINTS, WIDTH

SPAN = 1.0 / PICTURES


@pytest.fixture(scope="module")
def light() -> Robot:
    """Return a robot of simple shapes, whose page is made in a moment."""
    return pw.load_robot("humanoid-walker")


@pytest.fixture
def walk(light: Robot) -> pw.Walk:
    return pw.Walk.standing(light)


@pytest.fixture
def page(server: Any, walk: pw.Walk) -> LiveWalk:
    return LiveWalk(walk, server, None)


def test_it_walks_by_its_sliders_and_the_page_shows_it(
    server: Any, walk: pw.Walk, page: LiveWalk
) -> None:
    handle(server, "forward [m/s]").value = 0.4
    handle(server, "turn [rad/s]").value = -0.2
    assert walk.commanded == (0.4, 0.0, -0.2)
    for _ in range(3 * PICTURES):
        page.picture()
    assert walk.time == pytest.approx(3.0, abs=0.1)
    assert walk.plant.q[0] > 0.3
    shown = page._picture._nodes.frames[page._picture._stage.base]
    np.testing.assert_allclose(shown.position, configuration(walk)[:3], atol=1e-12)
    click(server, "Stand")
    assert walk.commanded == (0.0, 0.0, 0.0)
    assert handle(server, "forward [m/s]").value == 0.0


def test_the_sliders_end_at_what_the_legs_can_do(server: Any, walk: pw.Walk) -> None:
    walk.command(0.2, 0.0, 0.0)
    LiveWalk(walk, server, None)
    slider = handle(server, "forward [m/s]")
    assert slider.value == 0.2
    assert (slider.min, slider.max) == pytest.approx((-0.51, 1.04), abs=0.05)


def test_a_push_is_felt_and_recorded(server: Any, walk: pw.Walk, page: LiveWalk) -> None:
    """15 N s to the left in 0.2 s: 75 N, and a pelvis that moves to the left."""
    for _ in range(3):
        page.picture()
    click(server, "Push")
    for _ in range(10):
        page.picture()
    record = walk.record()
    (push,) = record.run.pushes
    assert push["duration"] == 0.2
    np.testing.assert_allclose(push["force"], [0.0, 75.0, 0.0], atol=0.5)
    assert record.push[:, 1].sum() * record.dt == pytest.approx(15.0, rel=0.02)
    assert np.abs(record.push[record.time < push["t"]]).max() == 0.0
    assert record.com_velocity[:, 1].max() > 0.005  # the stabilizer opposes it at once
    assert np.abs(record.com_velocity[record.time < push["t"], 1]).max() < 1e-4


def test_a_push_is_towards_where_the_robot_faces(server: Any, light: Robot) -> None:
    walk = pw.Walk.standing(light, (0.0, 0.0, np.pi / 2))
    page = LiveWalk(walk, server, None)
    handle(server, "towards [deg]").value = 0.0
    handle(server, "impulse [N·s]").value = 20.0
    click(server, "Push")
    page.picture()
    np.testing.assert_allclose(walk.record().run.pushes[0]["force"], [0.0, 100.0, 0.0], atol=1.0)


def test_pause_and_single_ticks(server: Any, walk: pw.Walk, page: LiveWalk) -> None:
    page.picture()
    paused = walk.time
    assert handle(server, "One tick").disabled
    click(server, "Pause")
    page.picture()
    assert walk.time == paused
    click(server, "One tick")
    click(server, "One tick")
    page.picture()
    assert walk.time == pytest.approx(paused + 2 * 0.002)
    click(server, "Play")
    page.picture()
    assert walk.time > paused + SPAN


def test_gains_change_under_way_and_the_record_tells(
    server: Any, walk: pw.Walk, page: LiveWalk
) -> None:
    page.picture()
    before = walk.gains
    handle(server, "dcm").value = 12.0
    page.picture()
    assert walk.gains.dcm == 12.0
    assert walk.walker.balance._rates.dcm == 12.0
    run = walk.record().run
    assert run.gains["dcm"] == before.dcm
    assert [change["gains"]["dcm"] for change in run.retuned] == [12.0]
    assert run.retuned[0]["t"] == pytest.approx(SPAN, abs=0.002)
    assert not run.fell


def test_what_is_refused_is_told_on_the_page(server: Any, walk: pw.Walk, page: LiveWalk) -> None:
    said: list[Any] = []

    class Visitor:
        @staticmethod
        def add_notification(*words: Any, **_: Any) -> None:
            said.append(words)

    class Click:
        client = Visitor

    walk._fall = (1.0, "it was tripped")
    (answer,) = handle(server, "Push")._impl.update_cb
    answer(Click)
    assert "it was tripped" in said[0][1]
    for _ in range(live.PLOT_EVERY + 1):
        page.picture()
    assert "fell: it was tripped" in page.controls._state.content
    with pytest.raises(InvalidInput, match="it was tripped"):
        walk.push((0.0, 1.0, 0.0), 0.1)


def test_the_end_is_by_the_page_or_by_ctrl_c(server: Any, walk: pw.Walk) -> None:
    ticks: list[float] = []

    def progress(time: float, end: float) -> None:
        assert end >= time
        ticks.append(time)
        if len(ticks) == 3:
            click(server, "End the walk")
        if len(ticks) == 6:
            raise KeyboardInterrupt

    run_live(walk, server, progress)
    assert len(ticks) == 3
    assert not walk.record().run.interrupted
    assert len(walk.record()) == round(3 * SPAN * 500) + 1
    server.scene.reset()
    server.gui.reset()
    run_live(walk, server, progress)
    assert len(ticks) == 6
    assert walk.record().run.interrupted


def test_nobody_looks_nobody_walks(
    server: Any, walk: pw.Walk, page: LiveWalk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "get_clients", dict)
    page.picture()
    assert walk.time == 0.0


def test_a_walk_that_is_asked_for_nothing_pauses(
    server: Any, walk: pw.Walk, page: LiveWalk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "IDLE", 0.1)
    for _ in range(3 * PICTURES):
        page.picture()
    assert not page.controls.playing
    assert 1.0 < walk.time < 1.5
    click(server, "Play")
    page.picture()
    assert page.controls.playing


def test_plots_have_what_the_record_has(server: Any, walk: pw.Walk, page: LiveWalk) -> None:
    handle(server, "left [m/s]").value = 0.1
    for _ in range(2 * PICTURES):
        page.picture()
    rows = page._traces.rows
    assert rows.shape == (2 * PICTURES, WIDTH)
    page._plots.show(rows)
    record = walk.record()
    at = np.searchsorted(record.time, rows[10:, 0] - record.dt - 1e-9)
    for axis, plot in enumerate(page._plots._plots):
        data = np.array(plot.data)
        np.testing.assert_array_equal(data[0], rows[:, 0])
        for k, point in enumerate(POINTS):
            for j, name in enumerate((point, f"{point}_ref")):
                lines = getattr(record, name)[at, axis]
                np.testing.assert_allclose(data[1 + 2 * k + j, 10:], lines, atol=2e-3)
    np.testing.assert_allclose(rows[10:, 1], record.com[at, 0], atol=1e-12)


def test_a_scene_of_ones_own_shows_what_is_in_it(server: Any, talos: Robot) -> None:
    """Also where another free body comes before the robot; the user's model stays as it is."""
    spec = spec_of(talos, visuals=True)
    box = spec.worldbody.add_body(name="box", pos=(1.0, 1.0, 0.2))
    box.add_freejoint()
    box.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1))
    model = spec.compile()
    before = bytes(model.geom_rgba), bytes(model.vis.rgba.contactforce)
    walk = pw.Walk.standing(pw.Scene(pw.load_robot(model), model, mujoco.MjData(model)))
    page = LiveWalk(walk, server, None)
    for _ in range(10):
        page.picture()
    frames = page._picture._nodes.frames
    for body in (model.body("box").id, page._picture._stage.base):
        np.testing.assert_allclose(frames[body].position, walk.plant.data.xpos[body], atol=2e-3)
    assert frames[model.body("box").id].position[2] < 0.2
    assert before == (bytes(model.geom_rgba), bytes(model.vis.rgba.contactforce))


def test_a_plant_of_ones_own_is_shown_too(server: Any, light: Robot) -> None:
    class Own:
        """Forwards to a world, and is none."""

        def __init__(self) -> None:
            self.world = pw.World(light)

        def __getattr__(self, name: str) -> Any:
            return getattr(self.__dict__["world"], name)

    walk = pw.Walk.standing(Own())
    page = LiveWalk(walk, server, None)
    page.picture()
    qpos = walk.plant.world.data.qpos
    np.testing.assert_allclose(configuration(walk), qpos, atol=1e-3)
    with pytest.raises(InvalidInput, match="push needs a walk in MuJoCo"):
        walk.push((1.0, 0.0, 0.0), 0.1)
