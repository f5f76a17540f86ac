"""Airborne: whether a robot is off the ground, and what its walk does until it is down again."""

from __future__ import annotations

from preview_walk.controller.feet import FootTarget
from preview_walk.controller.landing import Landing, held_soles, stood_soles
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.com_feedback import CentroidalState
from preview_walk.stabilizer.flight import UNFELT, Flight, feel, stand_on
from preview_walk.stabilizer.lift import Lift, Rise, Twist, observe_lift, observe_twist
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array, Foot


class Airborne:
    """Notices lifts and flights, holds the legs ready, and tells where the robot has come down.

    Attributes:
        lift: what holds the robot up beside the ground, as observed.
        twist: what turns it while it is lifted; None else.
        flight: whether the soles feel the ground.
        landing: how the legs are held; None on the ground.
    """

    def __init__(self, robot: Robot) -> None:
        """Begin on the ground."""
        self._robot = robot
        self._gravity = robot.gravity
        self._weight = robot.mass * robot.gravity
        self.lift = Lift()
        self.twist: Twist | None = None
        self.flight = Flight()
        self.landing: Landing | None = None

    def feel(self, t: float, load: float, body: WholeBodyController, plan: FootstepPlan) -> None:
        """Notice what lifts the robot, and flight.

        Args:
            t: now, s.
            load: of both soles as measured, as a share of the weight.
            body: at the measured state, with the last tick's solution.
            plan: the walk.
        """
        dynamics, planned = body.dynamics, 0.0
        if body.solution is not None:
            planned = sum(body.solution.wrench.tolist()[2::6]) / self._weight
        now = Rise(t, dynamics.com_velocity.item(2), load, planned)
        self.lift = observe_lift(self.lift, now, self._gravity)
        lifted = self.lift.lifted
        if lifted:
            momentum = dynamics.momentum_jacobian @ dynamics.v
            self.twist = observe_twist(self.twist, t, momentum)
        else:
            self.twist = None
        # How high the soles are matters only where they feel nothing.
        clearance = _clearance(t, dynamics, plan) if load <= UNFELT else 0.0
        self.flight = feel(self.flight, t, load, clearance, lifted)

    @property
    def borne(self) -> tuple[float, Array] | None:
        """The force (N), upward, and the moment (3,) about the CoM (N·m) of what lifts the robot.

        None where nothing does.
        """
        if self.twist is None:
            return None
        return self.lift.share * self._weight, self.twist.moment

    def fly(
        self, t: float, plan: FootstepPlan, dynamics: Dynamics, omega: float
    ) -> tuple[FootstepPlan | None, dict[Foot, FootTarget]]:
        """Hold the soles ready to land; return the plan that holds its steps back, or None.

        Args:
            t: now, s.
            plan: the walk.
            dynamics: at the measured state.
            omega: natural frequency of the pendulum, 1/s.

        Returns:
            another plan, or None while this one holds; and what each foot should do.
        """
        lifted, state = self.lift.lifted, CentroidalState(dynamics.com, dynamics.com_velocity)
        held = held_soles(self._robot, dynamics, state.velocity[:2] / omega, lifted)
        step, standing = plan.next_lift(t), None
        if self.landing is None or (step is not None and step.lift < t + plan.weight_shift):
            standing = stand_on(plan, t, held)
        if self.landing is None or self.landing.lifted != lifted:
            self.landing = Landing.begin(t, dynamics, lifted)
        fall = (1.0 - self.lift.share if lifted else 1.0) * self._gravity
        return standing, self.landing.targets(t, state, held, fall)

    def land(self, t: float, plan: FootstepPlan, dynamics: Dynamics) -> FootstepPlan | None:
        """Return the plan that stands where the robot has just come down; None if it has not.

        Args:
            t: now, s.
            plan: the walk.
            dynamics: at the measured state.
        """
        if self.landing is None:
            return None
        self.landing = None
        return stand_on(plan, t, stood_soles(dynamics))


def _clearance(t: float, dynamics: Dynamics, plan: FootstepPlan) -> float:
    """Return how high (m) the lower sole is above the plan's ground at time t (s)."""
    ground = max(float(plan.sole(foot, t)[2, 3]) for foot in FEET)
    return min(float(dynamics.soles[foot].position[2]) for foot in FEET) - ground
