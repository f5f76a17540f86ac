"""The walker: pattern, feedback and contacts of one tick, from measured state to torques."""

from __future__ import annotations

import numpy as np

from preview_walk.controller.feet import Feet, sole_pose
from preview_walk.controller.momentum_model import momentum_model
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.geometry.support import Sole, within_support
from preview_walk.pattern.com_height import LegGeometry
from preview_walk.pattern.walking_pattern import ComReference, WalkingPattern
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.recovery import Recovery
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot

SWING_HEIGHT = 0.06
"""Height of the swing foot's apex over the leg's length."""

LEAN = 0.1
"""How far beyond the soles (m per m of leg) the feedback may ask for the ZMP: what the soles cannot
give, trunk and arms do by their angular momentum."""


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
        self.feet = Feet(self.body, plan, self.weight, self.swing_height)
        self.recovery = Recovery(robot, self.pattern.omega)
        self.reference: ComReference | None = None
        self._zmp: Array = self.body.dynamics.com[:2].copy()

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
        self.recovery.answer(t, self.pattern, body.dynamics, self.feet, self._zmp)
        early = self.feet.follow(t, self.plan, normal_force)
        if early is not None:
            pose = sole_pose(body.dynamics.soles[early])
            self.recovery.touched_down(t, early, self.pattern, pose)
        self._track_com(t)
        self._track_torso(t)
        return body.torques(self.feet.normal_limits(t, self.plan))

    def _track_com(self, t: float) -> None:
        """Set the CoM task: the reference's acceleration and feedback of the DCM and CoM.

        The error e obeys e'' = -(omega + k) e' - omega k e: poles at -omega and at the DCM gain
        -k (Sugihara 2009; Englsberger et al. 2015 eq. 29). What pushes the DCM is opposed as it is
        observed, before an error has grown.
        """
        reference = self.reference = self.pattern.at(t)
        dynamics, omega, k = self.body.dynamics, self.pattern.omega, self.gains.dcm
        com, velocity = dynamics.com[:2], dynamics.com_velocity[:2]
        error = reference.com - dynamics.com
        rate = reference.velocity - dynamics.com_velocity
        # The feedback's ZMP: what it asks for beyond the soles' reach they cannot give.
        cart = reference.com[:2] - reference.acceleration[:2] / omega**2
        away = (com + velocity / omega) - (reference.com + reference.velocity / omega)[:2]
        zmp = cart + (1.0 + k / omega) * away + self.recovery.push / omega
        shift = reference.zmp - cart
        soles = [sole_pose(dynamics.soles[f]) for f in FEET if self.feet[f].contact]
        if soles:
            self._zmp = within_support(zmp + shift, soles, self.sole) - shift
            zmp = within_support(zmp + shift, soles, self._reach) - shift
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
                rate += 0.5 * self.body.foot_tasks[foot].velocity[5]
        self.body.torso.velocity = np.array((0.0, 0.0, rate))


def _legs(robot: Robot, dynamics: Dynamics) -> LegGeometry:
    """Return the leg geometry of a robot standing in its walking posture."""
    height = (
        dynamics.data.oMi[robot.legs["left"].hip].translation[2]
        - dynamics.soles["left"].position[2]
    )
    return LegGeometry(robot.leg_length, float(height), robot.com_height)
