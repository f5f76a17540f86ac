"""MuJoCo's state from a record's, against the simulation's own converter and MuJoCo's rotation."""

from __future__ import annotations

import dataclasses

import mujoco
import numpy as np
import pytest
from synthetic_walk import walk_record

from preview_walk.errors import InvalidInput
from preview_walk.record.record import Record
from preview_walk.robots.state import to_mujoco


@pytest.fixture(scope="module")
def tumbling() -> Record:
    """Return a record whose base faces anywhere, with velocities of any direction."""
    record = walk_record(2)
    random = np.random.default_rng(7)
    q, v = random.normal(size=record.q.shape), random.normal(size=record.v.shape)
    q[:, 3:7] /= np.linalg.norm(q[:, 3:7], axis=1, keepdims=True)
    return dataclasses.replace(record, q=q, v=v)


def test_state_is_that_of_the_simulations_converter_row_by_row(tumbling: Record) -> None:
    qpos, qvel = np.empty(10), np.empty(9)
    all_qpos, all_qvel = tumbling.qpos, tumbling.qvel
    for i in range(len(tumbling)):
        to_mujoco(tumbling.q[i], tumbling.v[i], qpos, qvel)
        np.testing.assert_array_equal(all_qpos[i], qpos)
        # Two forms of one rotation; velocities of order 1 m/s: some roundings of 1e-16.
        np.testing.assert_allclose(all_qvel[i], qvel, rtol=0, atol=3e-15)


def test_linear_velocity_is_turned_as_mujoco_turns(tumbling: Record) -> None:
    turned = np.empty(3)
    for i in range(0, len(tumbling), 37):
        mujoco.mju_rotVecQuat(turned, tumbling.v[i, :3], tumbling.qpos[i, 3:7])
        np.testing.assert_allclose(tumbling.qvel[i, :3], turned, rtol=0, atol=3e-15)
    np.testing.assert_array_equal(tumbling.qvel[:, 3:], tumbling.v[:, 3:])


def test_the_state_is_a_copy_that_cannot_be_mistaken_for_the_record(tumbling: Record) -> None:
    with pytest.raises(ValueError, match="read-only"):
        tumbling.qpos[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        tumbling.qvel[0, 0] = 1.0


def test_a_record_without_a_floating_base_is_refused(tumbling: Record) -> None:
    fixed = dataclasses.replace(tumbling, q=tumbling.q[:, :6])
    with pytest.raises(InvalidInput, match="record field 'q' must have 7 or more columns"):
        _ = fixed.qpos
    with pytest.raises(InvalidInput, match="got 6"):
        _ = fixed.qvel
