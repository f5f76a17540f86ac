"""Descriptions that no robot has: each ends in one sentence, soon, or gives a finite robot."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from robots.hostile import refused, taken

from preview_walk.robots.reading.description import models_folder

WALKER = (models_folder() / "humanoid-walker.xml").read_text()


DESCRIPTIONS = [
    "[" * 100_000,
    "[]",
    "null",
    "3",
    '{"model": 3}',
    '{"model": null}',
    '{"model": ""}',
    '{"model": "a\\u0000b.xml"}',
    '{"model": "' + "x" * 5000 + '.xml"}',
    *(
        f'{{"model": "walker.xml", {fact}}}'
        for fact in (
            '"title": 3',
            '"title": null',
            '"torso": null',
            '"torso": 7',
            '"torso": ["torso"]',
            '"soles": 3',
            '"soles": null',
            '"soles": []',
            '"soles": {"left": 1, "right": 2}',
            '"posture": "stand"',
            '"posture": null',
            '"posture": [1, 2]',
            '"posture": 4',
            '"posture": {"left_elbow": "bent"}',
            '"posture": {"left_elbow": NaN}',
            '"posture": {"left_elbow": null}',
            '"posture": {"left_elbow": true}',
            '"posture": {"left_elbow": 1e400}',
        )
    ),
    *(
        '{"model": "walker.xml", "soles": {'
        f'"left": {{"body": "left_foot", {fact}}}, "right": {{"body": "right_foot", {fact}}}}}}}'
        for fact in (
            '"size": "large"',
            '"size": 0.2',
            '"size": [0.2]',
            '"size": [0.2, 0.1, 0.1]',
            '"size": [0, 0]',
            '"size": [NaN, 0.1]',
            '"size": [Infinity, 0.1]',
            '"size": [-0.2, 0.1]',
            '"size": [1e5, 0.1]',
            '"size": ["a", "b"]',
            '"size": null',
            '"center": [0, 0]',
            '"center": "here"',
            '"center": [NaN, 0, 0]',
            '"center": [1e9, 0, 0]',
            '"colour": "red"',
        )
    ),
]


@pytest.mark.parametrize("text", DESCRIPTIONS, ids=lambda text: text[-60:])
def test_odd_descriptions(tmp_path: Path, text: str) -> None:
    (tmp_path / "walker.xml").write_text(WALKER)
    (tmp_path / "mine.json").write_text(text)
    refused(tmp_path / "mine.json")


def test_a_foot_is_no_trunk(tmp_path: Path) -> None:
    (tmp_path / "walker.xml").write_text(WALKER)
    (tmp_path / "mine.json").write_text('{"model": "walker.xml", "torso": "left_foot"}')
    assert refused(tmp_path / "mine.json") == (
        "the torso names the body 'left_foot', which is a part of the left leg; expected the trunk"
    )


values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=5,
)


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(key=st.sampled_from(("title", "model", "torso", "soles", "posture")), value=values)
def test_any_value_of_any_fact_is_taken_or_told(tmp_path: Path, key: str, value: object) -> None:
    (tmp_path / "walker.xml").write_text(WALKER)
    (tmp_path / "mine.json").write_text(json.dumps({"model": "walker.xml", key: value}))
    robot = taken(tmp_path / "mine.json")
    assert robot is None or np.isfinite(robot.posture).all()
