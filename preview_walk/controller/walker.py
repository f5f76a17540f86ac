"""The walker: one control tick, from measured state and live plan to joint torques."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from preview_walk.arguments import instance_of, number_within, real_array, shown
from preview_walk.controller.airborne import Airborne
from preview_walk.controller.balance import Balance
from preview_walk.controller.body_model import (
    BLIND_SWING_HEIGHT,
    SWING_HEIGHT,
    walker_model,
)
from preview_walk.controller.feeling import CAREFUL, FeltGround, settling
from preview_walk.controller.feet import DEEP_SEARCH, NOISY_SEARCH, SEARCH, Feet
from preview_walk.controller.friction import FrictionCompensation
from preview_walk.controller.hardware import Hardware, smoothing_time
from preview_walk.controller.landing import on_ground
from preview_walk.controller.robot_limits import gait_limits
from preview_walk.controller.torso import torso_motion
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.handover import refusal
from preview_walk.footsteps.laying import ROUGH, UNEVEN, relay, swung
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.com.sampled_plan import PLANNING_DT
from preview_walk.pattern.walking_pattern import ComReference, WalkingPattern
from preview_walk.robots.building.contact_sensor import zmp
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.com_feedback import CentroidalState, ComFeedback
from preview_walk.stabilizer.flight import waiting
from preview_walk.terrain.ground import Ground
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.measured import check_wrenches
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot


class Walker:
    """Walks a robot along a live plan: call `tick` with the measured state, `follow` another plan.

    Attributes:
        robot, gains, ground, blind: what it was made of.
        swing_height: of a swing's apex above the higher of its two soles, m.
        weight: of the robot, N.
        body: the whole-body controller; add tasks of one's own to it.
        pattern: the walking pattern of the plan.
        feet: which stand and which swing.
        reference: of the CoM at the last tick.
        feedback: what the stabilizer asked for at the last tick.
        balance: notices pushes and answers them.
        airborne: notices lifts and flights.
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
        hardware: Hardware | None = None,
    ) -> None:
        """Stand on the plan's first soles.

        Args:
            robot: from `load_robot`.
            plan: the walk.
            q: (nq,) configuration in which the robot stands on the plan's first soles, at rest.
            friction: Coulomb friction between soles and ground.
            gains: weights and gains of the tracker; None takes the defaults.
            solver: "osqp", "daqp" or another backend of qpsolvers.
            swing_height: m; None takes `SWING_HEIGHT` of the leg's length, or
                `BLIND_SWING_HEIGHT`.
            com_generator: "preview", "mpc" or "dcm".
            ground: what all steps are laid on; None takes footholds as they are given.
            blind: whether the ground is what the soles feel, wherever the plan has them.
            hardware: what is known of its imperfections; None: there are none.

        Raises:
            InvalidInput: there is no such solver or CoM generator.
        """
        self.robot = instance_of(robot, Robot, "robot")
        self.ground, self.blind, self.hardware = ground, blind, hardware
        instance_of(plan, FootstepPlan, "plan")
        self.gains = TrackingGains() if gains is None else gains
        q = real_array(q, "q", "the configuration of the robot")
        edge = 0.0 if hardware is None else hardware.edge(robot)
        self.body = WholeBodyController(robot, self.gains, friction, solver, edge=edge)
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
        model = walker_model(robot, self.swing_height)
        self.pattern = WalkingPattern(plan, com, model, com_generator)
        known = SEARCH if hardware is None else NOISY_SEARCH
        search = DEEP_SEARCH if blind else known
        self.feet = Feet(plan, self.weight, self.swing_height, search)
        self.reference: ComReference = self.pattern.at(plan.start)
        self.feedback = ComFeedback(np.zeros(3), com[:2], com[:2])
        self._planned_until = -np.inf
        lag = smoothing_time(hardware, blind)
        self.balance = Balance(robot, self.pattern.omega, self.gains, lag, hardware)
        self.airborne = Airborne(robot)
        self._felt = FeltGround(plan)
        self._friction = None if hardware is None else FrictionCompensation(hardware.friction)

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
        """Return a plan with its new steps on the ground, if known; `uneven`: see `relay`."""
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

    def tune(self, gains: TrackingGains) -> None:
        """Take other weights and gains of the tracker from now on."""
        self.gains = gains
        self.body.tune(gains)
        self.balance.tune(gains)

    def tick(
        self, t: float, q: Array, v: Array, wrench: Mapping[Foot, Array], spread: float = 0.0
    ) -> Array:
        """Return the joint torques (n,) in N·m for the state measured at time t.

        Args:
            t: now, s; must not go back.
            q: (nq,) configuration, Pinocchio's conventions.
            v: (nv,) velocity, Pinocchio's conventions.
            wrench: [force; moment] (6,) on each sole about its centre, world axes, N, N·m.
            spread: standard deviation of the base's horizontal velocity in v, m/s.

        Raises:
            StateError: the state cannot be measured: not finite, or absurd.
        """
        check_wrenches(wrench)
        normal_force = {foot: float(wrench[foot][2]) for foot in FEET}
        self.body.update(q, v)
        dynamics = self.body.dynamics
        state = CentroidalState(dynamics.com, dynamics.com_velocity)
        soles = {foot: dynamics.soles[foot].pose for foot in FEET}
        self.airborne.feel(t, sum(normal_force.values()) / self.weight, self.body, self.plan)
        borne = self.airborne.borne
        if borne is not None:
            dynamics.add_lift(*borne)
        if self.airborne.flight.airborne:
            self._fly(t)
        else:
            self._walk(t, soles, wrench, normal_force)
        self.reference = self.pattern.at(t)
        standing = [soles[foot] for foot in self.feet.standing]
        self.feedback = self.balance.feedback(state, self.reference, standing, spread)
        self._set_tasks()
        if self.blind:
            for foot, twist in settling(t, self.feet.states, wrench, self.body):
                self.body.settle[foot] = self.body.settle.get(foot, 0.0) + twist
        torques = self.body.torques(self.feet.normal_limits(t, self.plan))
        if self._friction is None:
            return torques
        limit = self.robot.effort
        torques = torques + self._friction.torques(t, self.body)
        return np.minimum(np.maximum(torques, -limit), limit)

    def _walk(
        self,
        t: float,
        soles: dict[Foot, Array],
        wrench: Mapping[Foot, Array],
        normal_force: dict[Foot, float],
    ) -> None:
        """Follow the plan, or another one where a landing, a push or the ground asks for it."""
        before = self.feet.states.copy()
        plan = self.airborne.land(t, self.plan, self.body.dynamics)
        if plan is not None:
            self._land(t, plan)
        if t >= self._planned_until:
            self._planned_until = t + PLANNING_DT - 1e-9
            self._replan(t, wrench)
        early = self.feet.follow(t, self.plan, soles, normal_force)
        if self.blind:
            plan = self._felt.feel(t, self.plan, (before, self.feet.states), soles)
            if plan is not None:
                self.follow(plan)
        if early is not None:
            lies = self.blind or self.hardware is None
            pose = soles[early] if lies else on_ground(soles[early], self.plan.swing_at(t))
            plan = self.balance.landed(t, self.plan, early, pose)
            if plan is not None:
                self.follow(plan)

    def _fly(self, t: float) -> None:
        """Hold the soles ready to land, and the plan's steps back."""
        plan, targets = self.airborne.fly(t, self.plan, self.body.dynamics, self.pattern.omega)
        if plan is not None:
            self.follow(plan)
        self.feet.fly(targets)

    def _land(self, t: float, plan: FootstepPlan) -> None:
        """Stand where the robot has come down; what pushed it before is forgotten."""
        self.balance.forget()
        self.follow(self.laid(plan))
        self.pattern.land(t, self.body.dynamics.com)
        self.feet.land(t)

    def _replan(self, t: float, wrench: Mapping[Foot, Array]) -> None:
        """Walk by another plan where a push asks for it; without ground to step on, wait."""
        dynamics = self.body.dynamics
        felt = None if self.hardware is None else self._felt_zmp(wrench)
        self.balance.observe(t, dynamics, self.feedback.sole_zmp, felt)
        if self.airborne.flight.flies or (self.blind and self.feet.searching):
            plan = waiting(self.plan, t)
            if plan is not None:
                self.follow(plan)
            return
        plan = self.balance.answer(t, self.pattern, self.feet, dynamics)
        if plan is not None:
            self.follow(self.laid(plan, ROUGH))
            self.pattern.rejoin(t, dynamics.com[:2] + self.balance.lean)

    def _felt_zmp(self, wrench: Mapping[Foot, Array]) -> Array | None:
        """Return the ZMP (2,) that the soles feel, m; None where they feel next to nothing."""
        soles = self.body.dynamics.soles
        left, right = soles["left"].position, soles["right"].position
        point = zmp((wrench["left"], wrench["right"]), (left, right), self.reference.ground)
        return point if np.isfinite(point).all() else None

    def _set_tasks(self) -> None:
        """Hand feedback and targets to the tasks; the torso stays upright between the feet."""
        body, targets = self.body, self.feet.targets
        body.com.acceleration = self.feedback.acceleration
        body.settle.clear()
        for foot, target in targets.items():
            task = body.foot_tasks[foot]
            task.pose, task.velocity = target.pose, target.velocity
            task.acceleration = target.acceleration
            if target.sink:
                body.settle[foot] = np.zeros(6)
                body.settle[foot][:3] = -target.sink * body.dynamics.soles[foot].rotation[2]
        body.torso.rotation, body.torso.velocity = torso_motion(targets)
