"""A sole's force sensor against MuJoCo's list of contacts; the ZMP against its definition."""

import mujoco
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from preview_walk.robots.building.contact_sensor import WrenchSensor, add_wrench_sensor, zmp
from preview_walk.types import Array

MASS, GRAVITY = 20.0, 9.81
OFFSET = np.array((0.03, -0.02))  # of the box's centre of mass from its middle, m


def world(block: bool = False) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return model and data of a box on the floor, with a smaller block on it where asked."""
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5.0, 5.0, 1.0), condim=4)
    body = spec.worldbody.add_body(name="box", pos=(0.4, -0.3, 0.05))
    body.add_freejoint()
    body.explicitinertial = True
    body.mass, body.inertia, body.ipos = MASS, (0.2, 0.2, 0.2), (*OFFSET, 0.0)
    body.add_geom(name="sole", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.06, 0.05), condim=4)
    if block:
        top = spec.worldbody.add_body(pos=(0.42, -0.32, 0.12))
        top.add_freejoint()
        top.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.02, 0.02, 0.02), mass=5.0)
    add_wrench_sensor(spec, "sole")
    model = spec.compile()
    return model, mujoco.MjData(model)


def by_hand(model: mujoco.MjModel, data: mujoco.MjData, origin: Array) -> Array:
    """Return the net wrench on the box about `origin`, summed over the contacts."""
    total, geom = np.zeros(6), model.geom("sole").id
    for index in range(data.ncon):
        contact, local = data.contact[index], np.zeros(6)
        if geom not in contact.geom:
            continue
        mujoco.mj_contactForce(model, data, index, local)
        axes = contact.frame.reshape(3, 3)
        # The force acts on the second geom of the pair.
        sign = 1.0 if contact.geom[1] == geom else -1.0
        force, moment = sign * local[:3] @ axes, sign * local[3:] @ axes
        total[:3] += force
        total[3:] += moment + np.cross(contact.pos - origin, force)
    return total


def read(model: mujoco.MjModel, data: mujoco.MjData, origin: Array) -> Array:
    wrench = np.zeros(6)
    WrenchSensor(model, "sole").read(data, np.asarray(origin, dtype=float), wrench)
    return wrench


@settings(max_examples=30)
@given(
    arrays(float, 6, elements=st.floats(-15.0, 15.0)),
    arrays(float, 3, elements=st.floats(-1.0, 1.0)),
    st.booleans(),
)
def test_reads_the_sum_of_all_contacts(push: Array, origin: Array, block: bool) -> None:
    """Any push, any reference point; the sensor's point is MuJoCo's, the sum is ours."""
    model, data = world(block)
    data.xfrc_applied[1] = push * (1.0, 1.0, 1.0, 0.1, 0.1, 0.1)
    mujoco.mj_step(model, data, 20)
    mujoco.mj_forward(model, data)
    assume(data.ncon > 0)
    assert read(model, data, origin) == pytest.approx(by_hand(model, data, origin), abs=1e-8)


@pytest.mark.parametrize("block", [False, True])
def test_a_box_at_rest_is_carried(block: bool) -> None:
    """What the sole feels is its own box's weight, whatever stands on it: the net of both."""
    model, data = world(block)
    mujoco.mj_step(model, data, 2000)
    wrench = read(model, data, data.xipos[1])
    assert wrench == pytest.approx([0.0, 0.0, MASS * GRAVITY, 0.0, 0.0, 0.0], abs=1e-3)


def test_the_zmp_at_rest_is_under_the_centre_of_mass() -> None:
    model, data = world()
    mujoco.mj_step(model, data, 2000)
    wrench, origin = read(model, data, data.xpos[1]), data.xpos[1]
    point = zmp((wrench, np.zeros(6)), (origin, np.zeros(3)), 0.0)
    assert point == pytest.approx(data.xipos[1][:2], abs=1e-6)
    assert point == pytest.approx(origin[:2] + OFFSET, abs=1e-3)


def test_nothing_in_the_air() -> None:
    model, data = world()
    data.qpos[2] += 0.1
    mujoco.mj_step(model, data)
    wrench = read(model, data, np.zeros(3))
    assert (wrench == 0.0).all()
    assert np.isnan(zmp((wrench, wrench), (np.zeros(3), np.zeros(3)), 0.0)).all()


forces = arrays(float, 6, elements=st.floats(-500.0, 500.0))
points = arrays(float, 3, elements=st.floats(-2.0, 2.0))


@given(forces, forces, points, points, st.floats(-1.0, 1.0))
def test_no_horizontal_moment_about_the_zmp(
    first: Array, second: Array, one: Array, other: Array, height: float
) -> None:
    assume(first[2] + second[2] > 5.0)
    point = np.append(zmp((first, second), (one, other), height), height)
    moment = np.zeros(3)
    for wrench, origin in ((first, one), (second, other)):
        moment += wrench[3:] + np.cross(origin - point, wrench[:3])
    scale = 1.0 + np.abs(point).max() * 1000.0
    assert np.abs(moment[:2]).max() < 1e-10 * scale


@given(forces, points, points)
def test_the_zmp_does_not_care_where_a_wrench_is_taken(
    wrench: Array, origin: Array, move: Array
) -> None:
    assume(wrench[2] > 5.0)
    moved = wrench.copy()
    moved[3:] -= np.cross(move, wrench[:3])
    nothing, zero = np.zeros(6), np.zeros(3)
    here = zmp((wrench, nothing), (origin, zero), 0.1)
    assert zmp((moved, nothing), (origin + move, zero), 0.1) == pytest.approx(here, abs=1e-9)
