"""A robot ready to walk: one model in two engines, its soles, limits and walking posture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import mujoco
import pinocchio as pin

from preview_walk.geometry.support import Sole
from preview_walk.robots.building.posture import Leg
from preview_walk.robots.finding.soles import SolePatch
from preview_walk.robots.finding.structure import Structure
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.urdf import Urdf
from preview_walk.types import Array, Foot


@dataclass(frozen=True)
class RobotSole:
    """A sole: its Pinocchio frame (the sole frame), MuJoCo geom and half size in m."""

    frame: int
    geom: int
    half_length: float
    half_width: float


@dataclass(frozen=True, eq=False)
class Blueprint:
    """What a robot was built from: enough to build its MuJoCo model again, with its looks.

    The tree of the source model and what stands for what in it, the joints (ids) locked and the
    joints (names) freed of their limits, the soles, the motors' limits (N·m) and the URDF, if any.
    """

    tree: Tree
    parts: Structure
    locked: frozenset[int]
    unlimited: tuple[str, ...]
    soles: Mapping[Foot, SolePatch]
    efforts: Mapping[str, float]
    urdf: Urdf | None


@dataclass(frozen=True, eq=False)
class Robot:
    """A legged robot in MuJoCo and Pinocchio, loaded by `preview_walk.load_robot`.

    Arrays over joints have one entry per joint below the floating base, in MuJoCo's and
    Pinocchio's common order (n = nv - 6).

    - `mj`, `pin`: the two models; `soles`: one per foot.
    - `legs`: each leg's Pinocchio joints, with hip, knee and ankle among them.
    - `torso`: Pinocchio frame on the trunk, aligned with the world in the walking posture.
    - `effort` (n,): largest joint torque in N·m, 0 for a joint without a motor.
    - `q_lower`, `q_upper` (n,): joint limits in rad, infinite where the model has none.
    - `v_limit` (n,): joint speed limits in rad/s, infinite where the model has none.
    - `damping` (n,): viscous joint friction in N·m·s/rad, which MuJoCo adds to the motors.
    - `posture` (nq,): Pinocchio configuration of the walking posture, with the midpoint between
      the soles at the origin and the robot facing x. The base may have any orientation in it.
    - `mass` (kg), `leg_length` (hip to sole, stretched), `step_width` (between the sole centres in
      the posture), `com_height` (of the posture above the soles), in m.
    - `notes`: what was assumed, adapted or left out, one sentence each.
    """

    name: str
    title: str
    source: str
    mj: mujoco.MjModel
    pin: pin.Model
    soles: Mapping[Foot, RobotSole]
    torso: int
    effort: Array
    q_lower: Array
    q_upper: Array
    v_limit: Array
    damping: Array
    posture: Array
    mass: float
    leg_length: float
    step_width: float
    com_height: float
    legs: Mapping[Foot, Leg]
    notes: tuple[str, ...]
    blueprint: Blueprint = field(repr=False)

    @property
    def sole(self) -> Sole:
        """Half sizes of the soles, m; both feet have the same."""
        return Sole(self.soles["left"].half_length, self.soles["left"].half_width)

    @property
    def gravity(self) -> float:
        """Acceleration of gravity in both models, m/s^2."""
        return -float(self.pin.gravity.linear[2])

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, in the order of the joint arrays."""
        return tuple(str(name) for name in self.pin.names[2:])
