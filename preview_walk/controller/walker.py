"""The walker: one control tick, from measured state and live plan to joint torques."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from preview_walk.arguments import instance_of, number_within, real_array, shown
from preview_walk.controller.feeling import CAREFUL, CONFORM_TIME, conforming, felt_planes
from preview_walk.controller.feet import DEEP_SEARCH, SEARCH, Feet, FootState
from preview_walk.controller.momentum_model import momentum_model
from preview_walk.controller.robot_limits import gait_limits, leg_geometry
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.handover import refusal
from preview_walk.footsteps.laying import ROUGH, UNEVEN, on_plane, relay, swung
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.planar import wrap
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.geometry.support import Sole
from preview_walk.pattern.com.sampled_plan import PLANNING_DT
from preview_walk.pattern.walker_model import WalkerModel
from preview_walk.pattern.walking_pattern import ComReference, WalkingPattern
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.com_feedback import (
    CentroidalState,
    ComFeedback,
    FeedbackGains,
    Support,
    com_feedback,
)
from preview_walk.stabilizer.disturbance import (
    ROUGH_SMOOTHING_TIME,
    SMOOTHING_TIME,
    Disturbance,
    observe,
)
from preview_walk.stabilizer.flight import Flight, feel, waiting
from preview_walk.stabilizer.recovery import RecoveryMemory, early_landing, recover
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_limits import step_limits
from preview_walk.terrain.ground import Ground, Plane
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.measured import check_wrenches
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot

SWING_HEIGHT = 0.06
"""Height of the swing foot's apex over the leg's length, where none is given."""

BLIND_SWING_HEIGHT = 0.12
"""The same where the ground is not known."""

LEAN = 0.1
"""How far beyond the soles (m per m of leg) the feedback may ask for the ZMP: what the soles cannot
give, trunk and arms do by their angular momentum."""


class Walker:
    """Walks a robot along a live plan: call `tick` with the measured state, `follow` another plan.

    Attributes:
        robot, gains, ground: what it was made of.
        swing_height: of a swing's apex above the higher of its two soles, m.
        weight: of the robot, N.
        body: the whole-body controller; add tasks of one's own to it.
        pattern: the walking pattern of the plan.
        feet: which stand and which swing.
        reference: of the CoM at the last tick.
        feedback: what the stabilizer asked for at the last tick.
        disturbance: what pushes the DCM, as observed.
        flight: whether the soles feel the ground.
    """

    def __init__(
        self,
        robot: Robot,
        plan: FootstepPlan,
        q: Array,
        *,
        friction: float,
        gains: TrackingGains | None = None,
        solver: str = "osqp",
        swing_height: float | None = None,
        com_generator: str = "preview",
        ground: Ground | None = None,
        blind: bool = False,
    ) -> None:
        """Stand on the plan's first soles.

        Args:
            robot: from `load_robot`.
            plan: the walk.
            q: (nq,) configuration in which the robot stands on the plan's first soles, at rest.
            friction: Coulomb friction between soles and ground.
            gains: weights and gains of the tracker; None takes the defaults.
            solver: "osqp", "daqp" or another backend of qpsolvers.
            swing_height: m; None takes `SWING_HEIGHT` of the leg's length.
            com_generator: "preview", "mpc" or "dcm".
            ground: what all steps are laid on; None takes footholds as they are given.
            blind: whether the ground is what the soles feel, wherever the plan has them.

        Raises:
            InvalidInput: there is no such solver or CoM generator.
        """
        self.robot = instance_of(robot, Robot, "robot")
        self.ground, self.blind = ground, blind
        instance_of(plan, FootstepPlan, "plan")
        self.plane = Plane.through(plan[0].pos, plan[0].pose[:3, 2])
        self.gains = TrackingGains() if gains is None else gains
        q = real_array(q, "q", "the configuration of the robot")
        self.body = WholeBodyController(robot, self.gains, friction, solver)
        if q.shape != (robot.pin.nq,):
            raise InvalidInput(f"q must be of shape ({robot.pin.nq},), got {shown(q)}.", "q")
        self.body.update(q, np.zeros(robot.pin.nv))
        leg = robot.leg_length
        self.swing_height = (
            (BLIND_SWING_HEIGHT if blind else SWING_HEIGHT) * leg
            if swing_height is None
            else number_within(swing_height, "swing_height", 0.0, leg, "m, the leg's length")
        )
        self.weight = robot.mass * robot.gravity
        com = self.body.dynamics.com.copy()
        model = WalkerModel(
            leg_geometry(robot), robot.sole, momentum_model(robot), self.swing_height
        )
        self.pattern = WalkingPattern(plan, com, model, com_generator)
        search = DEEP_SEARCH if blind else SEARCH
        self.feet = Feet(plan, self.weight, self.swing_height, search)
        self.disturbance = Disturbance()
        self.reference: ComReference = self.pattern.at(plan.start)
        self.feedback = ComFeedback(np.zeros(3), com[:2], com[:2])
        self._rates = FeedbackGains(self.pattern.omega, self.gains.dcm, self.gains.height)
        lean = LEAN * robot.leg_length
        self._reach = Sole(robot.sole.half_length + lean, robot.sole.half_width + lean)
        self._recovery = RecoveryMemory()
        self._limits = step_limits(
            robot.leg_length, robot.step_width, robot.sole, self.pattern.omega
        )
        self._planned_until = -np.inf
        self.flight = Flight()

    def __repr__(self) -> str:
        return f"Walker({self.robot.name}, {self.plan!r})"

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by."""
        return self.pattern.plan

    def follow(self, plan: FootstepPlan) -> None:
        """Walk by another plan from now on: the one place where plans are replaced."""
        self.pattern.follow(plan)

    def laid(self, plan: FootstepPlan, uneven: float = UNEVEN) -> FootstepPlan:
        """Return a plan with its new steps on the ground, as far as that is known.

        Args:
            plan: the walk to come.
            uneven: see `relay`.
        """
        if self.blind:
            return swung(plan, self.plan, CAREFUL)
        if self.ground is None:
            return plan
        return relay(plan, self.plan, self.ground, gait_limits(self.robot), uneven)

    def change(self, plan: FootstepPlan, t: float) -> None:
        """Walk by a plan that somebody else made, if it fits to where the feet are.

        Args:
            plan: the walk from now on.
            t: now, s.

        Raises:
            InvalidInput: it does not begin where the feet are, or is out of the legs' reach; the
                old plan goes on.
        """
        plan = self.laid(plan)
        soles = {foot: self.body.dynamics.soles[foot].pose for foot in FEET}
        refused = refusal(plan, self.plan, t, gait_limits(self.robot), soles)
        if refused is not None:
            raise refused
        self.follow(plan)

    def tick(self, t: float, q: Array, v: Array, wrench: Mapping[Foot, Array]) -> Array:
        """Return the joint torques (n,) in N·m for the state measured at time t.

        Args:
            t: now, s; must not go back.
            q: (nq,) configuration, Pinocchio's conventions.
            v: (nv,) velocity, Pinocchio's conventions.
            wrench: [force; moment] (6,) on each sole about its centre, world axes, N, N·m.

        Raises:
            StateError: the state cannot be measured: not finite, or absurd.
        """
        check_wrenches(wrench)
        normal_force = {foot: float(wrench[foot][2]) for foot in FEET}
        self.body.update(q, v)
        dynamics = self.body.dynamics
        state = CentroidalState(dynamics.com, dynamics.com_velocity)
        self.flight = feel(self.flight, t, sum(normal_force.values()) / self.weight)
        if t >= self._planned_until:
            self._planned_until = t + PLANNING_DT - 1e-9
            self._recover(t, state)
        soles = {foot: dynamics.soles[foot].pose for foot in FEET}
        before = self.feet.states.copy()
        early = self.feet.follow(t, self.plan, soles, normal_force)
        if self.blind:
            self._feel(t, before, soles)
        if early is not None:
            plan = early_landing(self.plan, t, early, soles[early], self._recovery)
            if plan is not None:
                self.follow(plan)
        self.reference = self.pattern.at(t)
        standing = [soles[foot] for foot in self.feet.standing]
        self.feedback = com_feedback(
            state,
            self.reference,
            self.disturbance.rate,
            Support(standing, self.robot.sole, self._reach),
            self._rates,
        )
        self._set_tasks()
        if self.blind:
            self._conform(t, wrench)
        return self.body.torques(self.feet.normal_limits(t, self.plan))

    def _recover(self, t: float, state: CentroidalState) -> None:
        """Observe what pushes the robot, and walk by another plan where recovery has one.

        In flight there is nothing to step on: the plan waits.
        """
        omega = self.pattern.omega
        dcm = state.dcm(omega)
        lag = ROUGH_SMOOTHING_TIME if self.blind else SMOOTHING_TIME
        self.disturbance = observe(self.disturbance, t, dcm, self.feedback.sole_zmp, omega, lag=lag)
        situation = Situation(
            t,
            self.plan,
            dcm,
            self.disturbance.rate,
            self.pattern.planned_dcm,
            self._free_swing(t),
        )
        if self.flight.flies or (self.blind and self.feet.searching):
            plan = waiting(self.plan, t)
            if plan is not None:
                self.follow(plan)
            return
        decision = recover(situation, self._recovery, self._limits)
        self._recovery = decision.memory
        if decision.plan is not None:
            self.follow(self.laid(decision.plan, ROUGH))
            self.pattern.rejoin(t, state.com[:2])

    def _feel(
        self, t: float, before: Mapping[Foot, FootState], soles: Mapping[Foot, Array]
    ) -> None:
        """Walk on over the ground as it has just been felt, if a foot has touched it or lifted."""
        for foot, plane in felt_planes(before, self.feet.states, soles, self.plane):
            self.plane = plane
            self.follow(on_plane(self.plan, foot, t, plane))

    def _conform(self, t: float, wrench: Mapping[Foot, Array]) -> None:
        """Turn soles that stand on an edge until they lie on the ground."""
        for foot in self.feet.standing:
            terms = self.body.dynamics.soles[foot]
            twist = conforming(
                wrench[foot], self.body.wrench(foot), terms.rotation, self.robot.sole
            )
            fresh = t - self.feet.states[foot].since < CONFORM_TIME
            if twist is not None and fresh:
                self.body.settle[foot] = self.body.settle.get(foot, 0.0) + twist

    def _free_swing(self, t: float) -> tuple[Array, Array] | None:
        """Return position and velocity (3,), world, of the sole that swings freely, or None."""
        step = self.plan.swing_at(t)
        if step is None or self.feet.states[step.foot].contact:
            return None
        sole = self.body.dynamics.soles[step.foot]
        return sole.position, sole.rotation @ sole.velocity[:3]

    def _set_tasks(self) -> None:
        """Hand feedback and targets to the tasks; the torso stays upright between the feet."""
        body, targets = self.body, self.feet.targets
        body.com.acceleration = self.feedback.acceleration
        body.settle.clear()
        turning = 0.0
        for foot, target in targets.items():
            task = body.foot_tasks[foot]
            task.pose, task.velocity = target.pose, target.velocity
            task.acceleration = target.acceleration
            if target.sink:
                body.settle[foot] = np.zeros(6)
                body.settle[foot][:3] = -target.sink * body.dynamics.soles[foot].rotation[2]
            if not target.contact:
                turning += 0.5 * float(target.velocity[5])
        a, b = yaw_of(targets["left"].pose), yaw_of(targets["right"].pose)
        body.torso.rotation = pose_at(0.0, 0.0, a + 0.5 * wrap(b - a))[:3, :3]
        body.torso.velocity = np.array((0.0, 0.0, turning))
