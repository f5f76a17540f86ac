"""Mismatch: how the robot in the physics differs from the model in the controller."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from preview_walk.arguments import real_array, shown
from preview_walk.errors import InvalidInput
from preview_walk.reality.checking import Checked

DEFAULT_SOFTNESS = 0.02
"""MuJoCo's time constant of a contact, s."""


@dataclass(frozen=True)
class Payload:
    """A mass that the controller does not know of.

    Attributes:
        mass: kg.
        body: that carries it; None: the base.
        point: where, in the body's axes, m.
    """

    mass: float
    body: str | None = None
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Check the values."""
        if not 0.0 < self.mass <= 1000.0:
            raise InvalidInput(
                f"the mass of a payload must be above 0 and up to 1000 kg, got {shown(self.mass)}.",
                "mass",
            )
        if real_array(self.point, "point", "three numbers, m").shape != (3,):
            raise InvalidInput(f"point must be three numbers, m, got {shown(self.point)}.", "point")


@dataclass(frozen=True)
class Mismatch(Checked):
    """Differences of the physics from the model; the controller does not know of them.

    Attributes:
        mass: every body's mass and inertia are off by up to this share, evenly distributed.
        inertia: every body's inertia by up to this share more.
        com: the whole robot's centre of mass is off by up to so much (m) along each axis; its
            heaviest body carries the difference.
        friction: (least, most) of the floor's Coulomb friction, evenly distributed; the controller
            counts on the least. None: what the world has, and told.
        softness: time constant of the contact of soles and floor, s; MuJoCo's is 0.02.
        payload: carried besides.
    """

    mass: float = 0.0
    inertia: float = 0.0
    com: float = 0.0
    friction: tuple[float, float] | None = None
    softness: float = DEFAULT_SOFTNESS
    payload: Payload | None = None


def misfit(model: mujoco.MjModel, mismatch: Mismatch, rng: np.random.Generator) -> None:
    """Change the masses of a model in place, as a mismatch has them.

    Args:
        model: of the world, robot in it.
        mismatch: the differences.
        rng: draws them.

    Raises:
        InvalidInput: the payload's body is not in the model.
    """
    # Drawn whether they are used or not, so that one setting does not change another's numbers.
    masses, inertias = rng.uniform(-1.0, 1.0, (2, model.nbody))
    offset = rng.uniform(-1.0, 1.0, 3)
    share = 1.0 + mismatch.mass * masses
    heaviest = int(np.argmax(model.body_mass))
    model.body_mass[:] *= share
    model.body_inertia[:] *= (share * (1.0 + mismatch.inertia * inertias))[:, None]
    if mismatch.com > 0.0:
        lever = model.body_mass.sum() / model.body_mass[heaviest]
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        turn = data.xmat[heaviest].reshape(3, 3)
        model.body_ipos[heaviest] += turn.T @ (mismatch.com * lever * offset)
    if mismatch.payload is not None:
        _load(model, mismatch.payload)
    # MuJoCo has noted which frames fall together; where they no longer do it must not go by that.
    for same in (model.body_sameframe, model.geom_sameframe, model.site_sameframe):
        same[:] = 0
    soft = model.geom_solref[:, 0] > 0.0
    model.geom_solref[soft, 0] *= mismatch.softness / DEFAULT_SOFTNESS
    mujoco.mj_setConst(model, mujoco.MjData(model))


def _load(model: mujoco.MjModel, payload: Payload) -> None:
    """Put a payload on its body: a point mass, by the parallel axis theorem."""
    names = [model.body(k).name for k in range(1, model.nbody)]
    body = 1 if payload.body is None else 1 + _index(payload.body, names)
    mass, more = float(model.body_mass[body]), payload.mass
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    axes = turn.reshape(3, 3)
    inertia = axes @ np.diag(model.body_inertia[body]) @ axes.T
    centre, point = np.array(model.body_ipos[body]), np.array(payload.point, dtype=float)
    arm = point - centre
    inertia += mass * more / (mass + more) * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    values, vectors = np.linalg.eigh(inertia)
    vectors[:, 2] *= np.sign(np.linalg.det(vectors))
    mujoco.mju_mat2Quat(model.body_iquat[body], np.ascontiguousarray(vectors).reshape(9))
    model.body_inertia[body] = values
    model.body_ipos[body] = centre + more / (mass + more) * arm
    model.body_mass[body] = mass + more


def _index(body: str, names: list[str]) -> int:
    """Return the place of a body's name."""
    if body not in names:
        raise InvalidInput(
            f"the body of a payload must be one of {', '.join(names)}, got '{body}'.", "body"
        )
    return names.index(body)
