"""Whole walks of TALOS in MuJoCo: exact, repeatable, true to the physics, safe."""

import re
from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
import pinocchio as pin
import pytest
import qpsolvers
from tracking.states import FRICTION, full_load, standing_controller

from preview_walk import FootstepPlanner, Walk
from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.qp.condensed_backend import CondensedBackend
from preview_walk.tracking.qp.osqp_method import WarmOsqp
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.safety import DAMPED_POSTURE, LAST_SOLUTION, SOLVED
from preview_walk.tracking.qp.solution import Backend, Solution
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import Array, Foot

MakeWalk = Callable[..., Walk]


class Watched:
    """A walk's controller, with every tick's torques compared with daqp's on the whole QP."""

    def __init__(self, walk: Walk) -> None:
        self.body = walk.walker.body
        self.robot = walk.robot
        self.errors: list[float] = []
        self.residuals: list[float] = []
        self.constrained = 0
        self.contacts: set[tuple[Foot, ...]] = set()
        self._torques = self.body.torques
        self.body.torques = self.torques  # type: ignore[method-assign, assignment]

    def torques(self, normal_limit: dict[Foot, float]) -> Array:
        torques = self._torques(normal_limit)
        problem, solution = self.body.problem(normal_limit), self.body.solution
        assert solution is not None
        exact = qpsolvers.solve_problem(problem.build(), "daqp", primal_tol=1e-10, dual_tol=1e-10)
        assert exact.x is not None
        right = problem.forces(*problem.split(exact.x))[6:]
        right = np.clip(right, -self.robot.effort, self.robot.effort)
        self.errors.append(float(np.abs(torques - right).max()))
        base = problem.forces(solution.acceleration, solution.wrench)[:6]
        self.residuals.append(float(np.abs(base).max()) / (9.81 * self.robot.mass))
        self.constrained += solution.iterations > 0
        self.contacts.add(problem.contacts)
        assert (np.abs(torques) <= self.robot.effort).all()
        return torques


@pytest.mark.parametrize(
    ("length", "time", "steps", "enough"), [(0.25, 0.9, 3, 0), (0.6, 0.6, 8, 50)]
)
def test_torques_are_those_of_an_exact_solver_at_every_tick(
    talos: Robot, length: float, time: float, steps: int, enough: int
) -> None:
    planner = FootstepPlanner(length, talos.step_width, time)
    walk = Walk(talos, planner.generate_footsteps(steps, ramp=4 if length > 0.5 else 0))
    watched = Watched(walk)
    walk.run(until=walk.plan.end)
    assert not walk.fallen
    assert max(watched.errors) <= 0.05
    assert max(watched.residuals) <= 1e-5
    assert walk.walker.body.failures == 0
    assert watched.constrained >= enough  # the fast walk reaches limits of joints and contacts
    assert watched.contacts == {("left", "right"), ("left",), ("right",)}


def test_a_walk_repeats_bit_for_bit(make_walk: MakeWalk) -> None:
    first, second = (make_walk().run(until=3.0).record() for _ in range(2))
    np.testing.assert_array_equal(first.tau, second.tau)
    np.testing.assert_array_equal(first.q, second.q)


def test_torques_do_not_jump_where_contacts_change(make_walk: MakeWalk) -> None:
    record = make_walk(3).run().record()
    # The motors' largest torques are 300 N·m; in steady support a tick changes them by 2.
    assert np.abs(np.diff(record.tau[5:], axis=0)).max() <= 15.0


def test_predicted_accelerations_are_those_of_mujoco(make_walk: MakeWalk) -> None:
    """In quiet single support, without the dry friction of joints, which the QP does not model.

    What is left is MuJoCo's contact: a spring on which the loaded sole rocks by a few tenths of
    rad/s^2 where the QP holds it still. The trunk feels little of it; the joints of the stance
    ankle, which carry it, take it all.
    """
    walk = make_walk()
    walk.plant.model.dof_frictionloss[:] = 0.0
    walk.run(until=2.0)  # 0.4 s into the first swing
    body, checked = walk.walker.body, 0
    torques = body.torques
    ankle = [walk.robot.joint_names.index(f"leg_right_{k}_joint") for k in (5, 6)]
    others = np.delete(np.arange(walk.robot.pin.nv - 6), ankle)

    def check(normal_limit: dict[Foot, float]) -> Array:
        nonlocal checked
        tau = torques(normal_limit)
        assert list(normal_limit) == ["right"]
        assert body.solution is not None
        predicted, simulated = body.solution.acceleration, simulated_acceleration(walk, tau)
        error = np.abs(predicted - simulated)
        assert error[:3].max() <= 0.01  # m/s^2
        assert error[3:6].max() <= 0.05  # rad/s^2
        assert error[6:][others].max() <= 0.2
        assert error[6:][ankle].max() <= 1.0
        com = body.dynamics.com_jacobian @ (predicted - simulated)
        assert np.abs(com).max() <= 0.01  # m/s^2
        checked += 1
        return tau

    body.torques = check  # type: ignore[method-assign, assignment]
    walk.run(until=2.2)
    assert checked == 100


def simulated_acceleration(walk: Walk, torques: Array) -> Array:
    """Return MuJoCo's acceleration (nv,) for these torques, in Pinocchio's conventions."""
    world, dynamics = walk.plant, walk.walker.body.dynamics
    data = mujoco.MjData(world.model)
    data.qpos[:], data.qvel[:] = world.data.qpos, world.data.qvel
    data.ctrl[:] = torques[world.model.jnt_dofadr[world.model.actuator_trnid[:, 0]] - 6]
    mujoco.mj_forward(world.model, data)
    acceleration = np.array(data.qacc)
    rotation = dynamics.data.oMi[1].rotation
    v = dynamics.v
    acceleration[:3] = rotation.T @ data.qacc[:3] - np.cross(v[3:6], v[:3])
    return acceleration


def test_joint_limits_hold_on_an_ideal_robot(talos: Robot) -> None:
    """The posture lies beyond the arms' limits and pulls hard; accelerations are integrated."""
    gains = TrackingGains(posture_weight=0.02)
    body = WholeBodyController(talos, gains, FRICTION)
    arms = [i for i, name in enumerate(talos.joint_names) if name.startswith("arm_")]
    body.posture.posture = np.where(np.isin(np.arange(32), arms), 3.5, talos.posture[7:])
    q, v, dt = np.array(talos.posture), np.zeros(talos.pin.nv), 1e-3
    furthest, fastest = 0.0, 0.0
    for _ in range(1500):
        body.update(q, v)
        body.torso.rotation = np.eye(3)
        body.com.acceleration = -4.0 * body.dynamics.com_velocity
        body.torques(full_load(talos))
        assert body.status == SOLVED
        assert body.solution is not None
        v = v + dt * body.solution.acceleration
        q = pin.integrate(talos.pin, q, dt * v)
        furthest = max(furthest, float((q[7:] - talos.q_upper).max()))
        fastest = max(fastest, float((np.abs(v[6:]) / talos.v_limit).max()))
    assert furthest <= 1e-3
    assert fastest <= 1.0 + 1e-3
    reached = talos.q_upper[arms] - q[7:][arms]
    assert (reached < 0.01).sum() >= 10  # they did reach their limits


def test_speed_limits_hold_on_an_ideal_robot(talos: Robot) -> None:
    slow = replace(talos, v_limit=np.minimum(talos.v_limit, 0.5))
    body = WholeBodyController(slow, TrackingGains(), FRICTION)
    body.posture.posture = talos.posture[7:] + 0.5
    body.update(np.array(talos.posture), np.zeros(talos.pin.nv))
    q, v, dt = np.array(talos.posture), np.zeros(talos.pin.nv), 1e-3
    fastest = 0.0
    for _ in range(500):
        body.update(q, v)
        body.com.acceleration = -4.0 * body.dynamics.com_velocity
        body.torques(full_load(talos))
        assert body.solution is not None
        v = v + dt * body.solution.acceleration
        q = pin.integrate(talos.pin, q, dt * v)
        fastest = max(fastest, float(np.abs(v[6:]).max()))
    assert 0.49 <= fastest <= 0.5 + 1e-3


class FailsNow:
    """One solve in a hundred, drawn by a seeded generator, is replaced by a failure."""

    def __init__(self, backend: Backend) -> None:
        self.backend = backend
        self.rng = np.random.default_rng(0)

    def solve(self, problem: TickProblem) -> Solution:
        solution = self.backend.solve(problem)
        if self.rng.random() < 0.01:
            return replace(solution, solved=False, status="injected")
        return solution


def test_a_walk_with_one_percent_of_failed_solves_does_not_fall(make_walk: MakeWalk) -> None:
    walk = make_walk(3)
    body = walk.walker.body
    body.backend = FailsNow(body.backend)
    record = walk.run().record()
    assert not walk.fallen
    assert body.failures >= 10
    assert np.count_nonzero(record.qp_status == LAST_SOLUTION) == body.failures
    assert np.abs(record.com - record.com_ref)[250:].max() <= 0.01


def test_standing_survives_a_solver_that_never_works_again(make_walk: MakeWalk) -> None:
    walk = make_walk(1)
    walk.run(until=0.3)
    body = walk.walker.body

    class Dead:
        def solve(self, problem: TickProblem) -> Solution:
            raise RuntimeError("dead")

    body.backend = Dead()
    walk.run(until=1.2)
    assert not walk.fallen
    assert body.status == DAMPED_POSTURE
    assert np.abs(walk.plant.v[6:]).max() < 0.5


def test_a_walk_with_nan_in_one_measured_velocity_stops_and_says_so(make_walk: MakeWalk) -> None:
    walk = make_walk(1)
    walk.run(until=0.5)
    sense = walk.plant.sense

    def broken() -> None:
        sense()
        walk.plant.v[6 + walk.robot.joint_names.index("arm_left_3_joint")] = np.nan

    walk.plant.sense = broken  # type: ignore[method-assign]
    walk.run()
    assert walk.fallen
    assert walk.record().run.fall_reason == (
        "the measured state must be finite, got nan for the velocity of joint 'arm_left_3_joint'."
    )


def test_a_walk_with_five_iterations_at_most_still_walks(make_walk: MakeWalk) -> None:
    """What OSQP does not finish, the active-set method does."""
    walk = make_walk(2)
    walk.walker.body.backend = CondensedBackend(WarmOsqp(max_iterations=5))
    record = walk.run().record()
    assert not walk.fallen
    assert (record.qp_status == SOLVED).all()


class HoldHand:
    """A task of one's own: a hand stays where it is in the world."""

    rows = 3
    weight = 10.0

    def __init__(self, body: WholeBodyController) -> None:
        self.hand = body.dynamics.frame("arm_right_7_link")
        self.goal = self.hand.position.copy()

    def update(self, dynamics: object, jacobian: Array, target: Array) -> None:
        hand = self.hand
        jacobian[:] = hand.rotation @ hand.jacobian[:3]
        target[:] = 100.0 * (self.goal - hand.position)
        target -= hand.rotation @ (20.0 * hand.velocity[:3] + hand.drift[:3])


def test_a_task_of_ones_own(make_walk: MakeWalk) -> None:
    errors = []
    for own in (True, False):
        walk = make_walk(1)
        body = walk.walker.body
        hold = HoldHand(body)
        if own:
            body.torques(full_load(walk.robot))  # also after the first tick
            body.add_task(hold)
        walk.run(until=1.5)  # the CoM shifts over the stance foot
        errors.append(float(np.linalg.norm(hold.hand.position - hold.goal)))
    assert errors[0] < 0.01 < errors[1]


@pytest.mark.parametrize(("rows", "weight"), [(0, 1.0), (3, 0.0), (3, -1.0), (3, np.inf)])
def test_a_task_that_cannot_be(talos: Robot, rows: int, weight: float) -> None:
    class Odd(HoldHand):
        pass

    body = standing_controller(talos)
    odd = Odd(body)
    odd.rows, odd.weight = rows, weight
    said = f"a task must have rows >= 1 and a weight > 0, got rows = {rows} and weight = {weight}."
    with pytest.raises(InvalidInput, match=re.escape(said)):
        body.add_task(odd)


def test_the_momentum_task_is_there_when_it_has_a_weight(talos: Robot) -> None:
    assert standing_controller(talos).momentum not in standing_controller(talos).tasks
    body = standing_controller(talos, gains=TrackingGains(momentum_weight=0.01))
    assert body.momentum in body.tasks
    body.momentum.momentum = np.array([0.0, 5.0, 0.0])
    body.torques({})  # in the air only gravity acts: no moment about the CoM
    assert body.status == SOLVED
    body.torques(full_load(talos))
    assert body.solution is not None
    rate = body.dynamics.momentum_jacobian @ body.solution.acceleration
    rate += body.dynamics.momentum_drift
    assert rate[1] > 1.0


def test_wrenches_are_what_the_soles_then_feel(make_walk: MakeWalk) -> None:
    walk = make_walk(2)
    walk.run(until=2.0)
    wrench = walk.walker.body.wrench("right")
    np.testing.assert_array_equal(walk.walker.body.wrench("left"), 0.0)
    walk.plant.sense()
    felt = walk.plant.wrench["right"]
    np.testing.assert_allclose(wrench[:3], felt[:3], atol=10.0)
    np.testing.assert_allclose(wrench[3:], felt[3:], atol=3.0)
