"""The physics differs from the model by what was asked for, and by nothing else."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.reality.mismatch import misfit
from preview_walk.robots.robot import Robot


def changed(robot: Robot, mismatch: pw.Mismatch, seed: int = 0) -> mujoco.MjModel:
    model = copy.deepcopy(robot.mj)
    misfit(model, mismatch, np.random.default_rng(seed))
    return model


def com_and_inertia(model: mujoco.MjModel) -> tuple[np.ndarray, np.ndarray, float]:
    """Return CoM, the inertia about it at rest, and the mass of the whole robot."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    com, whole = data.subtree_com[1].copy(), np.zeros((3, 3))
    for k in range(1, model.nbody):
        turn = data.ximat[k].reshape(3, 3)
        arm = data.xipos[k] - com
        whole += turn @ np.diag(model.body_inertia[k]) @ turn.T
        whole += model.body_mass[k] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return com, whole, float(model.body_subtreemass[1])


def test_nothing_asked_for_changes_nothing(talos: Robot) -> None:
    com, inertia, mass = com_and_inertia(talos.mj)
    same = com_and_inertia(changed(talos, pw.Mismatch()))
    np.testing.assert_allclose(same[0], com, atol=1e-9)
    np.testing.assert_allclose(same[1], inertia, atol=1e-6)
    assert same[2] == pytest.approx(mass)


def test_masses_are_off_by_up_to_a_share(talos: Robot) -> None:
    model = changed(talos, pw.Mismatch(mass=0.05))
    heavy = talos.mj.body_mass > 0.0
    share = model.body_mass[heavy] / talos.mj.body_mass[heavy]
    assert 0.95 <= share.min() < 0.96
    assert 1.04 < share.max() <= 1.05
    inertia = talos.mj.body_inertia[heavy] * share[:, None]
    np.testing.assert_allclose(model.body_inertia[heavy], inertia)


def test_the_whole_robots_com_is_moved(talos: Robot) -> None:
    """By the same amount as drawn, up to 1 cm along each axis."""
    before, _, _ = com_and_inertia(talos.mj)
    for seed in range(5):
        rng = np.random.default_rng(seed)
        rng.uniform(-1.0, 1.0, (2, talos.mj.nbody))
        drawn = 0.01 * rng.uniform(-1.0, 1.0, 3)
        after, _, _ = com_and_inertia(changed(talos, pw.Mismatch(com=0.01), seed))
        np.testing.assert_allclose(after - before, drawn, atol=1e-9)


def test_a_payload_is_a_point_mass(talos: Robot) -> None:
    """Mass, CoM and inertia of the whole are those of robot and point together."""
    com, inertia, mass = com_and_inertia(talos.mj)
    data = mujoco.MjData(talos.mj)
    mujoco.mj_forward(talos.mj, data)
    body, point = "arm_left_7_link", np.array((0.1, -0.05, 0.2))
    there = data.body(body).xpos + data.body(body).xmat.reshape(3, 3) @ point
    load = pw.Payload(7.0, body, (0.1, -0.05, 0.2))
    after = com_and_inertia(changed(talos, pw.Mismatch(payload=load)))
    assert after[2] == pytest.approx(mass + 7.0)
    np.testing.assert_allclose(after[0], (mass * com + 7.0 * there) / (mass + 7.0), atol=1e-7)
    arm = there - com
    share = mass * 7.0 / (mass + 7.0)
    inertia = inertia + share * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    np.testing.assert_allclose(after[1], inertia, atol=1e-5)


def test_a_payload_on_nothing_is_refused(talos: Robot) -> None:
    with pytest.raises(InvalidInput, match=r"must be one of .*, got 'nose'"):
        changed(talos, pw.Mismatch(payload=pw.Payload(1.0, "nose")))
