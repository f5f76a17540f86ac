"""Whole walks of TALOS in MuJoCo: exact, repeatable, true to the physics, safe."""

from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
import pinocchio as pin
import pytest
import qpsolvers
from tracking.states import FRICTION, full_load, standing_controller

from preview_walk import FootstepPlanner, Walk
from preview_walk.robots.robot import Robot
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.qp.safety import SOLVED
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
