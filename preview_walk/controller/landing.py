"""Landing: where a robot in flight holds its soles, and on which it stands when it is down.

And where a sole of a walking robot lies that has come down early on ground that is known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from preview_walk.controller.feet import FootTarget
from preview_walk.footsteps.footstep import Footstep
from preview_walk.geometry.poses import pose_at, rpy_of, yaw_of
from preview_walk.geometry.quintic import Quintic
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.com_feedback import CentroidalState
from preview_walk.terrain.ground import Plane
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.types import FEET, Array, Foot

GATHER = 0.3
"""Time (s) in which the soles come to where they are held: a step's, so that the swing of the legs
does not turn the body."""

LEAN = 4.0
"""How far the legs of a lifted robot swing with a lean of its trunk: at 1 they keep their place in
the body, beyond it their weight turns the body back about where it is held."""

LEAN_TIME = 0.5
"""A turn of the body counts as the lean that it makes in this time (s)."""


@dataclass(frozen=True, eq=False)
class Landing:
    """How the legs come to where they are held; made again when the robot is let go.

    Attributes:
        since: when they began, s.
        lifted: whether something bore the robot then.
        start: (3,) of each sole then, from the CoM, m.
        moving: (3,) its velocity then, from that of the CoM, m/s.
    """

    since: float
    lifted: bool
    start: dict[Foot, Array]
    moving: dict[Foot, Array]

    @classmethod
    def begin(cls, t: float, dynamics: Dynamics, lifted: bool) -> Landing:
        """Return the landing that begins at time t (s)."""
        start, moving = {}, {}
        for foot in FEET:
            sole = dynamics.soles[foot]
            start[foot] = sole.position - dynamics.com
            moving[foot] = sole.rotation @ sole.velocity[:3] - dynamics.com_velocity
        return cls(t, lifted, start, moving)

    def targets(
        self, t: float, state: CentroidalState, held: dict[Foot, Array], fall: float
    ) -> dict[Foot, FootTarget]:
        """Return what each foot should do at time t (s): move as the CoM does, and gather below it.

        Args:
            t: now, s.
            state: the measured motion of the CoM.
            held: pose (4, 4) of each sole when gathered.
            fall: downward acceleration of the CoM, m/s^2.
        """
        end, rest = self.since + GATHER, (0.0, 0.0, 0.0)
        share, rate, change = Quintic.between(self.since, end, rest, (1.0, 0.0, 0.0)).at(t)
        drift, slowing, braking = Quintic.between(self.since, end, (0.0, 1.0, 0.0), rest).at(t)
        targets: dict[Foot, FootTarget] = {}
        for foot in FEET:
            way, speed = held[foot][:3, 3] - state.com - self.start[foot], self.moving[foot]
            pose = held[foot].copy()
            pose[:3, 3] = state.com + self.start[foot] + share * way + drift * speed
            velocity, acceleration = np.zeros(6), np.zeros(6)
            velocity[:3] = state.velocity + rate * way + slowing * speed
            acceleration[:3] = change * way + braking * speed
            acceleration[2] -= fall
            targets[foot] = FootTarget(False, pose, velocity, acceleration)
        return targets


def held_soles(robot: Robot, dynamics: Dynamics, shift: Array, lifted: bool) -> dict[Foot, Array]:
    """Return where the soles are held in flight, (4, 4), level, and turned as the trunk is.

    They are as in a stand below the CoM: for one who falls `shift` away, for one who is lifted
    swung with the body's lean.

    Args:
        robot: whose they are.
        dynamics: at the measured state.
        shift: (2,) of the DCM from the CoM, m.
        lifted: whether something bears the robot.
    """
    yaw = yaw_of(dynamics.torso.pose)
    facing = pose_at(0.0, 0.0, yaw)[:3, :3]
    middle, axes = dynamics.com.copy(), facing
    if lifted:
        lean = LEAN * pin.log3(dynamics.torso.rotation @ facing.T)
        axes = pin.exp3(lean + LEAN_TIME * dynamics.spin()) @ facing
    else:
        middle[:2] += shift
    soles = {}
    for foot, side in zip(FEET, (0.5, -0.5), strict=True):
        place = middle + axes @ np.array((0.0, side * robot.step_width, -robot.com_height))
        x, y, z = place.tolist()
        soles[foot] = pose_at(x, y, yaw, z)
    return soles


def stood_soles(dynamics: Dynamics) -> dict[Foot, Array]:
    """Return the soles (4, 4), level, on which a robot stands that has just come down.

    Both are as high as the lower one, which touches.
    """
    poses = {foot: dynamics.soles[foot].pose for foot in FEET}
    z = min(float(pose[2, 3]) for pose in poses.values())
    return {
        foot: pose_at(float(pose[0, 3]), float(pose[1, 3]), yaw_of(pose), z)
        for foot, pose in poses.items()
    }


def on_ground(sole: Array, step: Footstep | None) -> Array:
    """Return the pose (4, 4) of a sole that has come down on ground that is known to the plan.

    It touches with an edge first, and tilted as an ankle's friction has left it: steps planned from
    there would all be in the air.
    """
    if step is None:
        return sole
    x, y, _ = sole[:3, 3].tolist()
    roll, pitch, _ = rpy_of(step.pose)
    height = Plane.through(step.pos, step.pose[:3, 2]).height(x, y)
    return pose_at(x, y, yaw_of(sole), float(height), pitch, roll)
