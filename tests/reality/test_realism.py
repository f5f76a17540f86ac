"""Realism as a value: presets, checks, names."""

from __future__ import annotations

import pickle
from dataclasses import replace

import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput


def test_presets_by_name() -> None:
    assert pw.read_realism("none") is None
    assert pw.read_realism("lab") == pw.Realism.lab()
    assert pw.read_realism("field") == pw.Realism.field()
    assert pickle.loads(pickle.dumps(pw.Realism.lab())) == pw.Realism.lab()
    with pytest.raises(InvalidInput, match="one of none, lab, field, got 'moon'"):
        pw.read_realism("moon")


def test_the_field_is_twice_as_bad() -> None:
    lab, field = pw.Realism.lab(), pw.Realism.field()
    assert field.delay == pytest.approx(2.0 * lab.delay)
    assert field.imu.gyro_noise == 2.0 * lab.imu.gyro_noise
    assert field.motors.dry_friction == 2.0 * lab.motors.dry_friction
    assert field.mismatch.com == 2.0 * lab.mismatch.com


@pytest.mark.parametrize("bad", [-1.0, float("nan"), float("inf"), "two", None, [1.0]])
def test_every_number_is_checked(bad: object) -> None:
    lab = pw.Realism.lab()
    for part, name in ((lab.encoders, "noise"), (lab.imu, "gyro_bias"), (lab.motors, "delay")):
        with pytest.raises(InvalidInput, match=name):
            replace(part, **{name: bad})  # type: ignore[arg-type]


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(InvalidInput, match="0 < least <= most"):
        pw.Mismatch(friction=(0.9, 0.5))
    with pytest.raises(InvalidInput, match="the part of a fault must be one of encoder"):
        pw.Fault("knee")
    with pytest.raises(InvalidInput, match="share of torque"):
        pw.Fault("motor", "knee")
    with pytest.raises(InvalidInput, match="imu must be"):
        pw.Realism(imu=pw.Encoders())  # type: ignore[arg-type]
