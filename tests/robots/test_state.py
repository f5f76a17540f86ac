"""The one converter between the engines' states."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from preview_walk.robots.state import to_mujoco, to_pinocchio

N_JOINTS = 4
seeds = st.integers(0, 2**32 - 1)


def random_state(seed):
    random = np.random.default_rng(seed)
    qpos = random.uniform(-2.0, 2.0, 7 + N_JOINTS)
    qpos[3:7] /= np.linalg.norm(qpos[3:7])
    return qpos, random.uniform(-3.0, 3.0, 6 + N_JOINTS)


@given(seeds)
def test_there_and_back_again(seed):
    qpos, qvel = random_state(seed)
    q, v, qpos_back, qvel_back = (np.empty_like(x) for x in (qpos, qvel, qpos, qvel))
    to_pinocchio(qpos, qvel, q, v)
    to_mujoco(q, v, qpos_back, qvel_back)
    np.testing.assert_allclose(qpos_back, qpos, atol=1e-14)
    np.testing.assert_allclose(qvel_back, qvel, atol=1e-13)


@given(seeds)
def test_base_velocity_is_turned_as_scipy_would(seed):
    qpos, qvel = random_state(seed)
    q, v = np.empty_like(qpos), np.empty_like(qvel)
    to_pinocchio(qpos, qvel, q, v)
    w, x, y, z = qpos[3:7]
    turn = Rotation.from_quat((x, y, z, w))
    np.testing.assert_allclose(turn.apply(v[:3]), qvel[:3], atol=1e-14)


def test_quaternion_that_drifted_is_normalised():
    qpos, qvel = random_state(1)
    q, v = np.empty_like(qpos), np.empty_like(qvel)
    qpos[3:7] *= 1.001
    to_pinocchio(qpos, qvel, q, v)
    assert np.linalg.norm(q[3:7]) == pytest.approx(1.0, abs=1e-15)


@given(seeds)
def test_both_engines_integrate_to_the_same_place(seed):
    """The velocities mean the same: each engine's own integrator ends in the same state."""
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="base", mass=1.0, inertia=(1.0, 1.0, 1.0))
    body.explicitinertial = True
    body.add_freejoint()
    mj = spec.compile()
    model = pin.Model()
    model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "root")
    qpos, qvel = (x[:-N_JOINTS] for x in random_state(seed))
    q, v = np.empty(7), np.empty(6)
    to_pinocchio(qpos, qvel, q, v)
    step = 1e-4
    mujoco.mj_integratePos(mj, qpos, qvel, step)
    moved, _ = np.empty(7), np.empty(6)
    to_pinocchio(qpos, qvel, moved, np.empty(6))
    gap = pin.difference(model, pin.integrate(model, q, v * step), moved)
    # MuJoCo moves the origin straight, Pinocchio along the screw: equal to second order.
    np.testing.assert_allclose(gap, 0.0, atol=20 * step**2)
