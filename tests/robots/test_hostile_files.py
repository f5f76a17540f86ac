"""Files that no robot has: each ends in one sentence, soon, and none is walked in silence."""

from __future__ import annotations

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from robots.hostile import refused, taken

from preview_walk.errors import RobotError
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import models_folder

WALKER = (models_folder() / "humanoid-walker.xml").read_text()


def chain(joints: str, links: str = "abcdef") -> str:
    """Return a URDF of links by their letters and of joints given as XML."""
    named = "".join(f'<link name="{name}"/>' for name in links)
    return f'<robot name="r">{named}{joints}</robot>'


def joint(name: str, parent: str, child: str, kind: str = "revolute", inside: str = "") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="0 0 1"/>{inside}</joint>'
    )


URDFS = {
    "unknown encoding": ('<?xml version="1.0" encoding="klingon"?><robot/>', "unknown encoding"),
    "codec that is no text": ('<?xml version="1.0" encoding="base64"?><robot/>', "cannot read"),
    "codec of names": ('<?xml version="1.0" encoding="idna"?><robot/>', "cannot read"),
    "wide encoding": ('<?xml version="1.0" encoding="utf-32"?><robot/>', "cannot read"),
    "multi-byte encoding": ('<?xml version="1.0" encoding="shift_jis"?><robot/>', "cannot read"),
    "own child": (chain(joint("j", "a", "a", "floating"), "a"), "0 root links"),
    "own child beside a root": (
        chain(joint("i", "a", "b") + joint("j", "c", "c", "floating"), "abc"),
        "their own ancestors (c)",
    ),
    "world in itself": (
        '<robot name="r"><link name="world"/>' + joint("j", "world", "world") + "</robot>",
        "0 root links",
    ),
    "floating circle": (
        chain(joint("i", "a", "b", "floating") + joint("j", "b", "a", "floating"), "ab"),
        "0 root links",
    ),
    "circle beside a root": (
        chain(joint("h", "a", "b") + joint("i", "c", "d") + joint("j", "d", "c"), "abcd"),
        "their own ancestors (c, d)",
    ),
    "diamond": (
        chain(
            joint("h", "a", "b")
            + joint("i", "a", "c")
            + joint("j", "b", "d")
            + joint("k", "c", "d"),
            "abcd",
        ),
        "the link 'd' is the child of two joints, 'j' and 'k'; expected one",
    ),
    "two joints to one child": (
        chain(joint("i", "a", "b") + joint("j", "a", "b"), "ab"),
        "the link 'b' is the child of two joints, 'i' and 'j'; expected one",
    ),
    "one name for two joints": (
        chain(joint("j", "a", "b") + joint("j", "b", "c"), "abc"),
        "has 2 joints called 'j'; expected one",
    ),
    "one name for two links": (chain(joint("j", "a", "b"), "abb"), "2 links called 'b'"),
    "joint without a name": (chain(joint("", "a", "b"), "ab"), "has a joint without a name"),
    "no links": ("<robot/>", "0 root links"),
    "long chain": (
        "<robot>"
        + "".join(f'<link name="l{i}"/>' for i in range(2000))
        + "".join(joint(f"j{i}", f"l{i}", f"l{i + 1}") for i in range(1999))
        + "</robot>",
        "has 2000 links; at most 1000 are read",
    ),
    "deep chain": (
        "<robot>"
        + "".join(f'<link name="l{i}"/>' for i in range(900))
        + "".join(joint(f"j{i}", f"l{i}", f"l{i + 1}") for i in range(899))
        + "</robot>",
        "no two legs found",
    ),
}


@pytest.mark.parametrize(("text", "part"), URDFS.values(), ids=list(URDFS))
def test_odd_urdfs(tmp_path: Path, text: str, part: str) -> None:
    path = tmp_path / "my.urdf"
    path.write_text(text)
    assert part in refused(path)


@pytest.mark.parametrize("suffix", [".urdf", ".xml", ".json", ".mjcf"])
@pytest.mark.parametrize("content", [b"", b"\0", b"\xff\xfe\0", b"<", b"[" * 100_000, b"\x89PNG\r"])
def test_files_that_hold_something_else(tmp_path: Path, suffix: str, content: bytes) -> None:
    path = tmp_path / f"my{suffix}"
    path.write_bytes(content)
    refused(path)


@pytest.mark.parametrize("suffix", ["", ".urdf", ".xml", ".json"])
@pytest.mark.parametrize("name", ["x" * 300, "x" * 5000, "a\0b", "a/" * 3000 + "b", "\udcff"])
def test_names_that_no_file_can_have(name: str, suffix: str) -> None:
    with pytest.raises(RobotError):
        load_robot(name + suffix)


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    (tmp_path / "my.urdf").mkdir()
    assert "does not exist" in refused(tmp_path / "my.urdf")


BOX = '<link name="left_foot"><collision><geometry>{}</geometry></collision></link>'


@pytest.mark.parametrize("kind", ["collision", "visual"])
@pytest.mark.parametrize(
    "shape",
    [
        '<box size="1e30 1 1"/>',
        '<box size="-0.2 0.1 0.1"/>',
        '<box size="nan 0.1 0.1"/>',
        '<box size="inf 0.1 0.1"/>',
        '<sphere radius="-1"/>',
        '<cylinder radius="0.1" length="1e9"/>',
        '<mesh filename="a.stl" scale="1e30 1 1"/>',
    ],
)
def test_shapes_of_sizes_that_no_robot_has(tmp_path: Path, kind: str, shape: str) -> None:
    path = tmp_path / "my.urdf"
    look = f'<link name="a"><{kind}><geometry>{shape}</geometry></{kind}></link>'
    path.write_text(f"<robot>{look}</robot>")
    assert refused(path).startswith("the link 'a' has a ")


ABSURD = {
    "damping": ("left_knee", ("nan", "-1", "1e30")),
    "armature": ("left_knee", ("nan", "-1", "1e30")),
    "frictionloss": ("left_knee", ("nan", "-1", "1e30")),
    "pos": ("left_knee", ("nan 0 0", "1e30 0 0")),
}


@pytest.mark.parametrize(
    ("attribute", "value"),
    [(name, value) for name, (_, values) in ABSURD.items() for value in values],
)
def test_absurd_numbers_of_a_joint(tmp_path: Path, attribute: str, value: str) -> None:
    """In the body's or the joint's element: MuJoCo's own reader or the check tells."""
    path, head = tmp_path / "my.xml", '<joint name="left_knee" '
    assert head in WALKER
    path.write_text(WALKER.replace(head, f'{head}{attribute}="{value}" '))
    assert "left_knee" in refused(path) or attribute == "pos"


@pytest.mark.parametrize("mass", ["nan", "inf", "-1", "1e30"])
def test_absurd_masses(tmp_path: Path, mass: str) -> None:
    path = tmp_path / "my.xml"
    path.write_text(WALKER.replace('mass="21.6"', f'mass="{mass}"'))
    refused(path)


@pytest.mark.parametrize("effort", ["1e-300", "1e-9"])
def test_motors_without_any_force(tmp_path: Path, effort: str) -> None:
    path = tmp_path / "my.xml"
    path.write_text(WALKER.replace('ctrlrange="-200 200"', f'ctrlrange="-{effort} {effort}"'))
    assert "the motor of the joint 'left_knee' gives" in refused(path)


@pytest.mark.parametrize(
    "copies",
    [
        '<replicate count="1000000"><geom size="1"/></replicate>',
        '<replicate count="1000"><replicate count="1000"><geom size="1"/></replicate></replicate>',
        '<composite type="grid" count="1000 1000 1" spacing="0.1"/>',
    ],
)
@pytest.mark.parametrize("included", [False, True])
def test_copies_without_end(tmp_path: Path, copies: str, included: bool) -> None:
    path, part = tmp_path / "my.xml", tmp_path / "part.xml"
    part.write_text(f"<mujoco><worldbody>{copies}</worldbody></mujoco>")
    inside = '<include file="part.xml"/>' if included else f"<worldbody>{copies}</worldbody>"
    path.write_text(f"<mujoco>{inside}</mujoco>")
    assert refused(path).endswith("copies of its parts; at most 10000 are made")


NUMBER = re.compile(r"(?<=[\" ])-?\d+\.?\d*(?=[\" ])")
SPOTS = [m.span() for m in NUMBER.finditer(WALKER) if m.start() > WALKER.index("<worldbody>")]


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    spot=st.sampled_from(SPOTS),
    number=st.sampled_from(("nan", "inf", "-inf", "1e30", "-1e30", "1e-300", "-1", "1e308", "x")),
)
def test_any_number_of_a_model_is_taken_or_told(spot: tuple[int, int], number: str) -> None:
    """Whatever stands in one place of the file, the robot that comes out is finite."""
    text = WALKER[: spot[0]] + number + WALKER[spot[1] :]
    try:
        spec = mujoco.MjSpec.from_string(text)
    except ValueError:  # MuJoCo's own reader refuses it, as it does for a file
        return
    robot = taken(spec)
    if robot is not None:
        assert np.isfinite(robot.posture).all()
        assert (robot.effort < 1e7).all()
        assert 1.0 < robot.mass < 1e4
        assert 0.1 < robot.leg_length < 10.0
