"""The walker: pattern, feedback and contacts of one tick, from measured state to torques."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.planning.com_height import LegGeometry
from preview_walk.planning.dcm import nearest_inside
from preview_walk.planning.footsteps import FootstepPlan
from preview_walk.planning.pattern import ComReference, WalkingPattern
from preview_walk.planning.pose import pose_at, yaw_of
from preview_walk.planning.support import Sole, support_polygon
from preview_walk.planning.swing_trajectory import Swing
from preview_walk.robots.posture import leg_joints
from preview_walk.robots.robot import Robot
from preview_walk.tracking.dynamics import Dynamics, FrameTerms
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.momentum_model import momentum_model
from preview_walk.tracking.recovery import Recovery
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot

SWING_HEIGHT = 0.06
"""Height of the swing foot's apex over the leg's length."""

CONTACT_FORCE = 0.03
"""A sole counts as on the ground when it carries this share of the weight."""

LEAN = 0.04
"""How far beyond the soles (m per m of leg) the feedback may ask for the ZMP: what the soles cannot
give, trunk and arms do by their angular momentum."""

RAMP_TIME = 0.02
"""Shortest time (s) over which a new contact may take its full load."""


@dataclass
class FootState:
    """Where a foot is in its step: in contact since `since`, or on `swing`."""

    contact: bool
    since: float
    swing: Swing | None
    pose: Array


class Walker:
    """Walks a robot along a live plan.

    Call `tick` with the measured state; assign `plan` at any time to change the walk.
    """

    def __init__(
        self,
        robot: Robot,
        plan: FootstepPlan,
        q: Array,
        friction: float,
        gains: TrackingGains | None = None,
        solver: str = "osqp",
    ) -> None:
        self.robot = robot
        self.gains = TrackingGains() if gains is None else gains
        self.body = WholeBodyController(robot, self.gains, friction, solver)
        self.body.update(q, np.zeros(robot.pin.nv))
        half = robot.soles["left"]
        self.sole = Sole(half.half_length, half.half_width)
        lean = LEAN * robot.leg_length
        self._reach = Sole(half.half_length + lean, half.half_width + lean)
        self.swing_height = SWING_HEIGHT * robot.leg_length
        self.pattern = WalkingPattern(
            plan,
            self.body.dynamics.com.copy(),
            _legs(robot, self.body.dynamics),
            Sole(half.half_length, half.half_width),
            momentum_model(robot),
            self.swing_height,
        )
        self.weight = robot.mass * 9.81
        self.feet = {
            foot: FootState(True, -np.inf, None, plan.sole(foot, plan.start)) for foot in FEET
        }
        self.recovery = Recovery(robot, self.pattern.omega)
        self.reference: ComReference | None = None

    @property
    def plan(self) -> FootstepPlan:
        """The footsteps walked by."""
        return self.pattern.plan

    @plan.setter
    def plan(self, plan: FootstepPlan) -> None:
        self.pattern.plan = plan

    def tick(self, t: float, q: Array, v: Array, normal_force: dict[Foot, float]) -> Array:
        """Return the joint torques (n,) in N·m for the state measured at time t (s).

        `q`, `v`: Pinocchio's configuration and velocity; `normal_force`: what each sole's force
        sensor reads (N).
        """
        body = self.body
        body.update(q, v)
        self.recovery.answer(t, self.pattern, body.dynamics)
        self._contacts(t, normal_force)
        self._track_com(t)
        self._track_torso(t)
        return body.torques(self._normal_limits(t))

    def _contacts(self, t: float, normal_force: dict[Foot, float]) -> None:
        """Follow the plan's lifts and landings, and what the soles feel."""
        plan = self.pattern.plan
        step = plan.swing_at(t)
        for foot, state in self.feet.items():
            task = self.body.feet[foot]
            touching = normal_force[foot] > CONTACT_FORCE * self.weight
            if step is not None and step.foot == foot:
                if state.swing is None or state.swing.lift != step.lift:
                    terms = self.body.dynamics.feet[foot]
                    x, y, z = terms.position.tolist()
                    start = pose_at(x, y, _yaw(terms.rotation), z)
                    state.swing = Swing(start, step.pose, step.lift, step.land, self.swing_height)
                    state.contact = False
                late = (t - step.lift) / (step.land - step.lift) > 0.6
                if not state.contact and late and touching:
                    state.contact, state.since = True, t
                    touched = _pose(self.body.dynamics.feet[foot])
                    self.recovery.touched_down(t, foot, self.pattern, touched)
                if state.swing.end is not step.pose or state.swing.land != step.land:
                    state.swing = state.swing.retarget(t, step.pose, step.land)
                state.pose, task.velocity, task.acceleration = state.swing.at(t)
                task.pose = state.pose
            else:
                if not state.contact:
                    state.contact, state.since = True, t
                state.pose = plan.sole(foot, t)

    def _track_com(self, t: float) -> None:
        """Set the CoM task: the reference's acceleration and feedback of the DCM and CoM.

        The error e obeys e'' = -(omega + k) e' - omega k e: poles at -omega and at the DCM gain
        -k (Sugihara 2009; Englsberger et al. 2015 eq. 29).
        """
        reference = self.reference = self.pattern.at(t)
        dynamics, omega, k = self.body.dynamics, self.pattern.omega, self.gains.dcm
        com, velocity = dynamics.com[:2], dynamics.com_velocity[:2]
        error = reference.com - dynamics.com
        rate = reference.velocity - dynamics.com_velocity
        # The feedback's ZMP: what it asks for beyond the soles' reach they cannot give.
        cart = reference.com[:2] - reference.acceleration[:2] / omega**2
        away = (com + velocity / omega) - (reference.com + reference.velocity / omega)[:2]
        zmp = cart + (1.0 + k / omega) * away
        shift = reference.zmp - cart
        soles = [self.body.dynamics.feet[f] for f in FEET if self.feet[f].contact]
        poses = [_pose(terms) for terms in soles]
        if poses:
            zmp = nearest_inside(support_polygon(poses, self._reach), zmp + shift) - shift
        acceleration = np.zeros(3)
        acceleration[:2] = omega**2 * (com - zmp)
        h = self.gains.height
        acceleration[2] = reference.acceleration[2] + 2.0 * h * rate[2] + h * h * error[2]
        self.body.com.acceleration = acceleration

    def _track_torso(self, t: float) -> None:
        """Set the torso task: upright, facing between the feet."""
        left, right = (self.feet[foot].pose for foot in FEET)
        a, b = yaw_of(left), yaw_of(right)
        yaw = a + 0.5 * ((b - a + np.pi) % (2 * np.pi) - np.pi)
        self.body.torso.rotation = pose_at(0.0, 0.0, yaw)[:3, :3]
        rate = 0.0
        for foot in FEET:
            if not self.feet[foot].contact:
                rate += 0.5 * self.body.feet[foot].velocity[5]
        self.body.torso.velocity = np.array((0.0, 0.0, rate))

    def _normal_limits(self, t: float) -> dict[Foot, float]:
        """Return the normal force (N) each foot in contact may carry: ramped in double support."""
        plan = self.pattern.plan
        full = 2.0 * self.weight
        limits: dict[Foot, float] = {}
        lift = next((s for s in plan.steps if s.lift > t), None)
        for foot, state in self.feet.items():
            if not state.contact:
                continue
            share = min(1.0, (t - state.since) / RAMP_TIME + 0.02)
            if lift is not None and lift.foot == foot:
                share = min(share, (lift.lift - t) / RAMP_TIME + 0.01)
            limits[foot] = full * share
        return limits


def _legs(robot: Robot, dynamics: Dynamics) -> LegGeometry:
    """Return the leg geometry of a robot standing in its walking posture."""
    hip = leg_joints(robot.pin, robot.soles["left"].frame)[2]
    height = dynamics.data.oMi[hip].translation[2] - dynamics.feet["left"].position[2]
    return LegGeometry(robot.leg_length, float(height), robot.com_height)


def _pose(terms: FrameTerms) -> Array:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = terms.rotation, terms.position
    return pose


def _yaw(rotation: Array) -> float:
    return float(np.arctan2(rotation[1, 0], rotation[0, 0]))
