"""Tables, maps and pages of results that are known."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from study_cases import pushed

import preview_walk as pw
from preview_walk.studies.survival import wilson


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> pw.Results:
    study = pw.Study({"gain": [1.0, 2.0, 3.0], "push": [5.0, 15.0, 25.0, 91.0]}, pushed, repeats=2)
    return study.run(tmp_path_factory.mktemp("study"), jobs=1, progress=False)


def test_wilsons_interval_solves_its_equation() -> None:
    """Its ends are the shares p whose distance from k/n is 1.96 sqrt(p (1 - p) / n)."""
    for k, n in ((0, 7), (3, 10), (95, 100), (20, 20)):
        for p in wilson(k, n):
            assert abs(p - k / n) == pytest.approx(1.959964 * np.sqrt(p * (1 - p) / n), abs=1e-6)
    assert wilson(0, 0) == (0.0, 1.0)


def test_survival_counts_the_cases_of_each_level(results: pw.Results) -> None:
    by_gain = results.survival("gain")
    # Below ten times the gain, or in the island at 91.
    assert [*by_gain["succeeded"]] == [4, 6, 8]
    assert [*by_gain["cases"]] == [8, 8, 8]
    both = results.survival(("gain", "push"))
    assert both.loc[(1.0, 15.0), "share"] == 0.0
    assert both.loc[(2.0, 15.0), "share"] == 1.0
    assert results.survival().loc["all", "succeeded"] == 18
    assert results.varied == ("gain", "push")


def test_an_unknown_column_is_told_with_those_there_are(results: pw.Results) -> None:
    with pytest.raises(pw.InvalidInput, match="columns of gain, push, repeat, seed; got nothing"):
        results.survival("nothing")
    with pytest.raises(pw.InvalidInput, match="got margin"):
        results.margins("gain")


def test_a_map_shows_the_share_of_each_cell(results: pw.Results) -> None:
    figure = pw.heat_map(results, "push", "gain")
    axes = figure.axes[0]
    shown = np.asarray(axes.images[0].get_array())
    assert shown.tolist() == [[1, 0, 0, 1], [1, 1, 0, 1], [1, 1, 1, 1]]
    assert [text.get_text() for text in axes.get_xticklabels()] == ["5", "15", "25", "91"]


def test_a_polar_plot_has_a_closed_line_for_each_level(results: pw.Results) -> None:
    figure = pw.polar_plot(results, "push", "share", by="gain")
    lines = figure.axes[0].lines
    assert [line.get_label() for line in lines] == ["gain 1.0", "gain 2.0", "gain 3.0"]
    angles, radii = lines[1].get_data()
    assert np.degrees(np.asarray(angles)) == pytest.approx([5.0, 15.0, 25.0, 91.0, 5.0])
    assert np.asarray(radii).tolist() == [1.0, 1.0, 0.0, 1.0, 1.0]


def test_the_page_is_one_file_that_needs_nothing_else(results: pw.Results, tmp_path: Path) -> None:
    page = pw.write_report(results, tmp_path / "page.html").read_text()
    assert "By gain, push" in page
    assert "Cases that did not succeed: 6" in page
    assert page.count("data:image/png;base64,") == 1
    assert not re.search(r'(src|href)="(?!data:)', page)


def test_results_read_back_are_those_that_were_written(results: pw.Results) -> None:
    again = pw.read_results(results.folder)
    assert again.table.equals(results.table)
    assert repr(again) == "Results(24 cases, 18 succeeded)"
    with pytest.raises(pw.InvalidInput, match="folder must be one of a study"):
        pw.read_results(results.folder / "nowhere")
