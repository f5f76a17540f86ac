"""How much angular momentum a step carries: what the cart-table leaves out, to first order.

The cart-table assumes no angular momentum about the CoM. A swinging leg has some, and its rate
moves the ZMP: for a 0.5 m swing of TALOS in 0.7 s by 55 mm. In the walking posture, with the other
foot standing and the trunk upright, it is linear in the velocities of the swing foot and the CoM:

    L = foot @ v_foot + com @ v_com

which planning can foresee, because it knows how the foot will swing.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.pattern.swing_moment import MomentumModel
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array, Foot, other

_WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def momentum_model(robot: Robot) -> MomentumModel:
    """Return the momentum model of a robot in its walking posture, in heading axes.

    Joint velocities are the smallest ones that move the CoM or the swing foot while the stance
    foot, the trunk's orientation and the swing foot's orientation stay.
    """
    model = robot.pin
    data = model.createData()
    centroidal = pin.computeCentroidalMap(model, data, robot.posture)
    pin.computeJointJacobians(model, data)
    pin.updateFramePlacements(model, data)
    com = np.zeros((3, 3))
    feet = {}
    for foot in FEET:
        moved, carried = _of_swing(robot, data, centroidal, foot)
        com += 0.5 * carried
        feet[foot] = moved
    return MomentumModel(robot.mass, com, feet)


def _of_swing(robot: Robot, data: pin.Data, centroidal: Array, swing: Foot) -> tuple[Array, Array]:
    """Return L per velocity of the swing foot (3, 3) and per velocity of the CoM (3, 3)."""

    def jacobian(frame: int) -> Array:
        return np.asarray(pin.getFrameJacobian(robot.pin, data, frame, _WORLD))

    motion = np.linalg.pinv(
        np.vstack(
            [
                jacobian(robot.soles[swing].frame),
                centroidal[:3] / robot.mass,
                jacobian(robot.soles[other(swing)].frame),
                jacobian(robot.torso)[3:],
            ]
        )
    )
    momentum = centroidal[3:] @ motion
    return momentum[:, :3], momentum[:, 6:9]
