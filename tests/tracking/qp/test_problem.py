from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tracking.states import FRICTION, busy_problem, full_load, random_state, standing_controller

from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.qp.problem import (
    BRAKE,
    CONTACT_WEIGHT,
    LIMIT_RATE,
    LIMIT_WEIGHT,
    TILT_WEIGHT,
    TickProblem,
)
from preview_walk.tracking.tasks import Task
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import Array, Foot

BOTH: tuple[Foot, Foot] = ("left", "right")


def variables(problem: TickProblem, seed: int) -> Array:
    rng = np.random.default_rng(seed)
    values: Array = rng.standard_normal(problem.nv + problem.nf + problem.n)
    return values


@pytest.mark.parametrize("feet", [BOTH, ("left",), ()])
def test_build_is_the_cost_that_the_docstring_states(talos: Robot, feet: tuple[Foot, ...]) -> None:
    body = WholeBodyController(talos, TrackingGains(), FRICTION)
    q, v = random_state(talos, 1, 0.05)
    body.update(q, v)
    p = body.problem({foot: 800.0 for foot in feet})
    qp: Any = p.build()

    def cost(z: Array) -> float:
        a, f = p.split(z)
        e = z[p.nv + p.nf :]
        tasks = sum(
            task.weight * float(np.sum((jacobian @ a - target) ** 2))
            for task, jacobian, target in written(body, p)
        )
        weights = np.array([*3 * [CONTACT_WEIGHT], TILT_WEIGHT, TILT_WEIGHT, CONTACT_WEIGHT])
        contacts = sum(
            float(weights @ (terms.jacobian @ a + terms.drift + BRAKE * terms.velocity) ** 2)
            for terms in (body.dynamics.soles[foot] for foot in feet)
        )
        prior = float(p.regularization_weight @ (a - p.regularization_target) ** 2)
        wrenches = float(p.wrench_weight @ f**2)
        return 0.5 * (tasks + contacts + prior + wrenches + LIMIT_WEIGHT * float(e @ e))

    zero = np.zeros(len(qp.q))
    for seed in range(5):
        z = variables(p, seed)
        built = 0.5 * z @ qp.P @ z + qp.q @ z
        assert built == pytest.approx(cost(z) - cost(zero), rel=1e-9)


def written(body: WholeBodyController, p: TickProblem) -> list[tuple[Task, Array, Array]]:
    """Return every task of a problem with the rows that it writes."""
    found: list[tuple[Task, Array, Array]] = []
    for task in p.tasks:
        jacobian, target = np.zeros((task.rows, p.nv)), np.zeros(task.rows)
        task.update(body.dynamics, jacobian, target)
        found.append((task, jacobian, target))
    return found


def test_build_states_dynamics_torques_limits_and_contacts(talos: Robot) -> None:
    p = busy_problem(talos, 3)
    qp: Any = p.build()
    for seed in range(5):
        z = variables(p, seed)
        a, f = p.split(z)
        e = z[p.nv + p.nf :]
        forces = p.forces(a, f)
        np.testing.assert_allclose(100.0 * (qp.A @ z - qp.b), forces[:6], atol=1e-8)
        values = np.concatenate([forces[6:], a[6:] - e])
        inside = (values >= p.limits[0]) & (values <= p.limits[1])
        cone = p.contact_rows @ f
        normal = np.arange(len(cone)) % 17 == 16
        crossed = int((~inside).sum() + (cone > p.contact_high)[~normal].sum())
        assert int((qp.G @ z > qp.h).sum()) == crossed
        ok = (z >= qp.lb).all() and (z <= qp.ub).all()
        assert ok == bool(((cone >= p.contact_low) & (cone <= p.contact_high))[normal].all())


@given(st.integers(0, 10_000))
def test_acceleration_limits_never_contradict_each_other(seed: int) -> None:
    rng = np.random.default_rng(seed)
    p = PROBLEM
    q = rng.uniform(-3.0, 3.0, p.n)
    v = rng.uniform(-20.0, 20.0, p.n)
    p._fill_limits(q, v)
    low, high = p.limits[:, p.n :]
    assert (low <= high).all()


@given(st.floats(-1.0, 0.99), st.floats(0.0, 8.0))
def test_a_joint_at_its_limiting_acceleration_never_crosses_its_limit(q: float, v: float) -> None:
    """It keeps moving at constant speed until the limit brakes it."""
    dt, limit = 1e-3, 1.0
    distance = limit - q
    if 2.0 * v > LIMIT_RATE * distance:
        return  # already too fast when the limit is first asked
    for _ in range(2000):
        acceleration = min(0.0, LIMIT_RATE**2 * (limit - q) - 2.0 * LIMIT_RATE * v)
        v += dt * acceleration
        q += dt * v
        assert q <= limit + 1e-9


def test_limits_are_this_law(talos: Robot) -> None:
    body = standing_controller(talos)
    q, v = random_state(talos, 4, 0.05)
    body.update(q, v)
    p = body.problem(full_load(talos))
    fastest = LIMIT_RATE * (talos.v_limit - v[6:])
    braked = LIMIT_RATE**2 * (talos.q_upper - q[7:]) - 2.0 * LIMIT_RATE * v[6:]
    slowest = LIMIT_RATE * (-talos.v_limit - v[6:])
    np.testing.assert_allclose(p.limits[1, p.n :], np.clip(braked, slowest, fastest))
    caught = LIMIT_RATE**2 * (talos.q_lower - q[7:]) - 2.0 * LIMIT_RATE * v[6:]
    np.testing.assert_allclose(p.limits[0, p.n :], np.clip(caught, slowest, fastest))
    np.testing.assert_array_equal(p.limits[:, : p.n], [-talos.effort, talos.effort])


def test_a_contact_that_sinks_comes_to_its_speed(talos: Robot) -> None:
    body = standing_controller(talos)
    body.settle["left"] = np.array((0.0, 0.0, -0.05, 0.0, 0.0, 0.0))
    body.torques(full_load(talos, "right") | {"left": 0.0})
    assert body.solution is not None
    down = body.dynamics.soles["left"].jacobian @ body.solution.acceleration
    np.testing.assert_allclose(down[:3], [0.0, 0.0, -0.05 * BRAKE], atol=1e-3)
    np.testing.assert_allclose(down[3:], 0.0, atol=0.05)


def test_a_sole_that_tips_over_its_edge_is_let() -> None:
    """The ankle is at its limit and the leg leans on: keeping the sole flat would take a jump."""
    g1 = load_robot("g1")
    body = standing_controller(g1)
    legs = [g1.pin.idx_vs[joint] for joint in g1.legs["right"].joints]
    hip, ankle = (6 + g1.joint_names.index(f"right_{name}_roll_joint") for name in ("hip", "ankle"))
    q, v = np.array(g1.posture), np.zeros(g1.pin.nv)
    q[ankle + 1] = g1.q_upper[ankle - 6]
    q[hip + 1] = -q[ankle + 1]
    body.update(q, v)
    # The pelvis goes sideways, the ankle stays, and the sole's centre too: the sole tilts instead.
    jacobian = body.dynamics.soles["right"].jacobian
    moving = jacobian[:, legs].copy()
    moving[:, legs.index(ankle)] = [0.0, 0.0, 0.0, -1.0, 0.0, 0.0]
    v[1], v[legs] = 1.5, np.linalg.solve(moving, -1.5 * jacobian[:, 1])
    tilting, v[ankle] = v[ankle], 0.0
    body.update(q, v)
    np.testing.assert_allclose(
        body.dynamics.soles["right"].velocity, [0.0, 0.0, 0.0, tilting, 0.0, 0.0], atol=1e-9
    )
    body.com.acceleration = np.array([0.0, -2.5, 0.0])
    body.torques(full_load(g1, "right"))
    assert abs(tilting) > 2.0
    assert body.wrench("right")[2] < 1.15 * 9.81 * g1.mass


def test_the_load_is_shared_as_the_wanted_zmp_lies(talos: Robot) -> None:
    body = standing_controller(talos)
    body.torques(full_load(talos))
    left, right = (body.wrench(foot) for foot in BOTH)
    assert left[2] == pytest.approx(right[2], rel=1e-3)
    assert left[2] + right[2] == pytest.approx(9.81 * talos.mass, rel=1e-3)
    for up in (4.0, -4.0, 0.0):  # m/s^2; the weight that the ZMP bears grows with it
        lever = body.dynamics.com[2] / (9.81 + up)
        body.com.acceleration = np.array([0.0, -0.25 * talos.step_width / lever, up])
        body.torques(full_load(talos))
        left, right = (body.wrench(foot) for foot in BOTH)
        assert left[2] / (left[2] + right[2]) == pytest.approx(0.75, abs=0.02)
    assert np.abs([left[3:5], right[3:5]]).max() < 10.0


PROBLEM: TickProblem


@pytest.fixture(autouse=True, scope="module")
def _problem(talos: Robot) -> None:
    global PROBLEM
    PROBLEM = busy_problem(talos, 0)
