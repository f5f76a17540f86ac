"""The plots: what they draw is what the record holds, and they leave whole files."""

from __future__ import annotations

import dataclasses
import re
import sys
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread
from matplotlib.patches import Polygon
from synthetic_walk import DT, FOOT_ERROR, walk_record

from preview_walk.analysis.phase_plots import contact, timing_errors
from preview_walk.analysis.plots import (
    PLOTS,
    overview,
    plot,
    plot_all,
    save_plot,
    top_view,
    torques,
)
from preview_walk.analysis.style import COM, DCM, ZMP, darker, new_figure, spans
from preview_walk.analysis.top_view import draw_top_view, measured_footprints, planned_footprints
from preview_walk.errors import InvalidInput
from preview_walk.record.record import Record


@pytest.fixture(scope="module")
def record() -> Record:
    return walk_record(6, friction=0.8)


def test_every_plot_is_a_picture(record: Record, tmp_path: Path) -> None:
    paths = [plot(record, tmp_path / "walk.png"), *plot_all(record, tmp_path)]
    assert [path.stem for path in paths] == ["walk", *PLOTS]
    for path in paths:
        picture = imread(path)
        assert picture.shape[0] > 300
        assert picture.shape[1] > 1000
        assert np.ptp(picture[..., :3]) > 0.5
    assert len(list(tmp_path.iterdir())) == len(paths)


@pytest.mark.parametrize("joints", [32, 43, 60, 110])
def test_joint_names_do_not_overlap(record: Record, joints: int) -> None:
    names = tuple(f"leg_left_{k}_joint" for k in range(joints))
    tau = np.ones((len(record), joints))
    many = dataclasses.replace(record, tau=tau).with_run(joint_names=names, tau_max=(2.0,) * joints)
    figure = overview(many)
    figure.canvas.draw()
    (axes,) = (ax for ax in figure.axes if "Torques" in ax.get_title(loc="left"))
    boxes = [label.get_window_extent() for label in axes.get_yticklabels()]
    assert len(boxes) >= 30
    for above, below in pairwise(boxes):
        assert below.y1 <= above.y0


def test_com_dcm_and_zmp_are_told_apart() -> None:
    """The lines are far from each other in colour, and the dashes over them too."""
    for shade in (to_rgb, darker):
        for a, b in combinations((COM, DCM, ZMP), 2):
            assert np.linalg.norm(np.subtract(shade(a), shade(b))) > 0.3


def test_no_global_state_of_pyplot_is_touched(record: Record, tmp_path: Path) -> None:
    plot(record, tmp_path / "walk.pdf")
    pyplot = sys.modules.get("matplotlib.pyplot")
    assert pyplot is None or pyplot.get_fignums() == []


@pytest.mark.parametrize("start", [(0.0, 0.0, 0.0), (100.0, -50.0, 2.4)])
def test_top_view_shows_every_sole_where_it_was(start: tuple[float, float, float]) -> None:
    record = walk_record(6, start=start)
    axes = new_figure(8, 4).subplots()
    draw_top_view(axes, record)
    soles = [patch.get_xy()[:4] for patch in axes.patches if isinstance(patch, Polygon)]
    measured, planned = soles[:8], soles[8:]
    assert len(planned) == 8  # two standing soles and six steps
    np.testing.assert_allclose(planned[0].mean(axis=0), [0.0, 0.085], atol=1e-9)
    np.testing.assert_allclose(planned[-1].mean(axis=0), [5 * 0.25, -0.085], atol=1e-9)
    np.testing.assert_allclose(np.ptp(planned[3], axis=0), [0.21, 0.13], atol=1e-9)
    for was, should in zip(measured, planned, strict=True):
        np.testing.assert_allclose(was - should, np.tile(FOOT_ERROR[:2], (4, 1)), atol=1e-9)


def test_footprints_of_a_fallen_walk_are_those_reached(record: Record) -> None:
    until = int(np.searchsorted(record.time, record.plans[-1].landings[1])) + 5
    short = dataclasses.replace(
        record, **{name: array[:until] for name, array in record.arrays().items()}
    )
    assert len(planned_footprints(short)) == 8
    assert len(measured_footprints(short)) == 4


def test_timing_errors_find_the_delay(record: Record) -> None:
    lift, land = timing_errors(record)
    assert len(lift) == len(land) == 6
    # Measured phases come 15 ms late, seen to within a tick.
    np.testing.assert_allclose(lift, 0.015, atol=DT)
    np.testing.assert_allclose(land, 0.015, atol=DT)


def test_a_foot_that_never_lifts_has_no_timing(record: Record) -> None:
    still = dataclasses.replace(record, phase=np.zeros_like(record.phase))
    assert np.isnan(timing_errors(still)).all()


def test_contact_and_spans() -> None:
    phase = np.array([0, 1, 2, -1], dtype=np.int8)
    np.testing.assert_array_equal(contact(phase, "left"), [True, True, False, False])
    np.testing.assert_array_equal(contact(phase, "right"), [True, False, True, False])
    time = np.arange(5) * 0.1
    found = spans(time, np.array([True, False, True, True, True]))
    np.testing.assert_allclose(found, [(0.0, 0.1), (0.2, 0.3)])
    assert spans(time, np.zeros(5, dtype=bool)) == []


def test_torque_map_keeps_the_peaks_and_leaves_out_joints_without_motor(record: Record) -> None:
    tau = np.zeros_like(record.tau)
    tau[777, 1] = -50.0
    figure = torques(dataclasses.replace(record, tau=tau))
    (image,) = figure.axes[0].images
    values = np.asarray(image.get_array())
    assert [text.get_text() for text in figure.axes[0].get_yticklabels()] == ["hip", "knee"]
    assert values.max() == 1.0
    assert np.count_nonzero(values) == 1


def test_one_tick_and_unmeasured_forces_can_be_drawn(tmp_path: Path) -> None:
    record = walk_record(2)
    one = dataclasses.replace(
        record, **{name: array[:1] for name, array in record.arrays().items()}
    )
    plot(one, tmp_path / "one.png")
    nothing = np.full_like(record.left_force, np.nan)
    plot_all(dataclasses.replace(record, left_force_ref=nothing, zmp=record.zmp * np.nan), tmp_path)


def test_title_tells_where_the_walk_began() -> None:
    figure = top_view(walk_record(2, start=(1.0, 2.0, np.pi / 2)))
    title = figure.axes[0].get_title(loc="left")
    assert title == "Top view (from the start at 1.00, 2.00 m, heading 90°)"


def test_bad_suffix_and_empty_record_get_one_sentence(record: Record, tmp_path: Path) -> None:
    with pytest.raises(
        InvalidInput, match=r"a plot's file name must end in one of .*eps, .*png, .*, got"
    ):
        plot(record, tmp_path / "walk.xyz")
    sentence = f"a plot's name must be one of {', '.join(PLOTS)}, got 'side_view'."
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        save_plot(record, "side_view", tmp_path / "walk.png")
    empty = dataclasses.replace(
        record, **{name: array[:0] for name, array in record.arrays().items()}
    )
    sentence = "a plot needs a record of at least one tick, got an empty one."
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        plot(empty, tmp_path / "walk.png")
    assert list(tmp_path.iterdir()) == []
