"""A robot ready to walk: one model in two engines, its soles, limits and walking posture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.geometry.support import Sole
from preview_walk.html import html_table
from preview_walk.robots.building.leg import Leg
from preview_walk.robots.finding.soles import SolePatch
from preview_walk.robots.finding.structure import Structure
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.reading.urdf import UrdfFile
from preview_walk.types import Array, Foot


@dataclass(frozen=True)
class RobotSole:
    """A sole of a robot in both engines.

    Attributes:
        frame: its Pinocchio frame, the sole frame.
        geom: its MuJoCo geom.
        size: its rectangle, half sizes in m.
    """

    frame: int
    geom: int
    size: Sole

    @property
    def half_length(self) -> float:
        """Half of the extent from heel to toe, m."""
        return self.size.half_length

    @property
    def half_width(self) -> float:
        """Half of the extent from side to side, m."""
        return self.size.half_width


@dataclass(frozen=True, eq=False)
class Blueprint:
    """What a robot was built from: enough to build its MuJoCo model again, with its looks.

    Attributes:
        tree: the source model.
        parts: what stands for what in it.
        locked: joints (ids) that stay in their reference pose.
        unlimited: joints (names) freed of their limits.
        soles: where the soles are on their bodies.
        efforts: torque limits of the motors (N·m) by joint name.
        urdf: the URDF that holds the visual shapes, if the robot came from one.
    """

    tree: Tree
    parts: Structure
    locked: frozenset[int]
    unlimited: tuple[str, ...]
    soles: Mapping[Foot, SolePatch]
    efforts: Mapping[str, float]
    urdf: UrdfFile | None

    def __repr__(self) -> str:
        """Say it in one line."""
        made = "MuJoCo model" if self.urdf is None else f"'{self.urdf.path.name}'"
        return f"<Blueprint from a {made} of {self.tree.mj.nbody - 1} bodies>"


@dataclass(frozen=True, eq=False)
class Robot:
    """A legged robot in MuJoCo and Pinocchio, loaded by `preview_walk.load_robot`.

    Arrays over joints have one entry per joint below the floating base, in MuJoCo's and
    Pinocchio's common order (n = nv - 6). All arrays are read-only. A robot can be pickled and
    deep-copied, also into another process; the copy walks bit for bit as the original.

    Attributes:
        name: short name.
        title: name to be read.
        source: the file or model that it came from.
        mj: the MuJoCo model.
        pin: the Pinocchio model.
        soles: one per foot.
        torso: Pinocchio frame on the trunk, aligned with the world in the walking posture.
        effort: (n,), largest joint torque in N·m, 0 for a joint without a motor.
        q_lower: (n,), lower joint limits in rad, infinite where the model has none.
        q_upper: (n,), upper joint limits in rad, infinite where the model has none.
        v_limit: (n,), joint speed limits in rad/s, infinite where the model has none.
        damping: (n,), viscous joint friction in N·m·s/rad, which MuJoCo adds to the motors.
        posture: (nq,), Pinocchio configuration of the walking posture, with the midpoint between
            the soles at the origin and the robot facing x. The base may have any orientation.
        mass: in kg.
        leg_length: from hip to sole, stretched, m.
        step_width: between the sole centres in the posture, m.
        com_height: of the posture's CoM above the soles, m.
        legs: each leg's Pinocchio joints, with hip, knee and ankle among them.
        notes: what was assumed, adapted or left out, one sentence each.
        blueprint: what it was built from.
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
    blueprint: Blueprint

    def __post_init__(self) -> None:
        """Take the arrays as read-only copies of its own."""
        for name, value in tuple(vars(self).items()):
            if isinstance(value, np.ndarray) and value.flags.writeable:
                own = value.copy()
                own.setflags(write=False)
                object.__setattr__(self, name, own)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take a pickled or copied state; NumPy forgets there that an array is read-only."""
        vars(self).update(state)
        self.__post_init__()

    def __repr__(self) -> str:
        """Say it in one line."""
        return (
            f"<Robot '{self.name}': {self.mass:.1f} kg, {len(self.joint_names)} joints, "
            f"legs of {self.leg_length:.3f} m>"
        )

    def _repr_html_(self) -> str:
        """Return the robot's facts as a notebook shows them."""
        sole = self.sole
        size = f"{2e3 * sole.half_length:.0f} x {2e3 * sole.half_width:.0f} mm"
        rows = [
            ("mass", f"{self.mass:.1f} kg"),
            ("joints", str(len(self.joint_names))),
            ("leg", f"{self.leg_length:.3f} m"),
            ("CoM above the soles", f"{self.com_height:.3f} m"),
            ("step width", f"{self.step_width:.3f} m"),
            ("sole", size),
        ]
        return html_table(self.title or self.name, rows)

    @property
    def gravity(self) -> float:
        """Acceleration of gravity in both models, m/s^2."""
        return -float(self.pin.gravity.linear[2])

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, in the order of the joint arrays."""
        return tuple(str(name) for name in self.pin.names[2:])

    @cached_property
    def sole(self) -> Sole:
        """The rectangle that lies within both soles, half sizes in m."""
        left, right = self.soles["left"].size, self.soles["right"].size
        return Sole(
            min(left.half_length, right.half_length), min(left.half_width, right.half_width)
        )
