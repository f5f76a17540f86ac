"""The plant: what a walk needs of a robot that can be sensed and driven."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push
from preview_walk.terrain.ground import Ground
from preview_walk.types import Array, Foot


class Plant(Protocol):
    """A robot on the ground; `Walk` senses it, computes torques and lets it step.

    Two are here: `World`, the project's own, and `Scene`, a MuJoCo model that somebody else made.
    One's own needs these attributes and methods, no base class.
    """

    @property
    def robot(self) -> Robot:
        """The robot in it."""

    @property
    def ground(self) -> Ground:
        """What it stands on."""

    @property
    def friction(self) -> float:
        """Coulomb friction between soles and ground; the controller is told."""

    @property
    def timestep(self) -> float:
        """Time of a physics step, s."""

    @property
    def q(self) -> Array:
        """(nq,) configuration as of the last `sense`, Pinocchio's conventions."""

    @property
    def v(self) -> Array:
        """(nv,) velocity as of the last `sense`, Pinocchio's conventions."""

    @property
    def wrench(self) -> Mapping[Foot, Array]:
        """(6,) per foot, ground on robot: [force; moment about the sole's centre], world axes."""

    @property
    def pushes(self) -> Sequence[Push]:
        """The forces on it that are known beforehand, for the record."""

    @property
    def push(self) -> Array:
        """(3,) sum of the pushes in the last physics step, world axes, N."""

    def place(self, q: Array, t: float) -> None:
        """Stand the robot still in configuration q (nq,) at time t (s) of the walk."""

    def sense(self) -> None:
        """Read the state and the soles' wrenches into `q`, `v` and `wrench`."""

    def step(self, torques: Array, steps: int) -> None:
        """Hold the joint torques (n,), N·m, for a number of physics steps."""
