"""Put a robot's spec into a world it can walk in: floor, light, box soles, torque motors."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco

from preview_walk.errors import RobotError
from preview_walk.robots.contact_sensor import add_wrench_sensor
from preview_walk.robots.description import SoleFact
from preview_walk.types import Foot

SOLE_THICKNESS = 0.02
"""Height of the box that stands for a sole (m); its lower face is the sole plane."""


def sole_name(foot: Foot) -> str:
    """Return the name of the site and of the box geom of a sole in the assembled model."""
    return f"{foot}_sole"


def assemble(spec: mujoco.MjSpec, soles: Mapping[Foot, SoleFact]) -> None:
    """Add floor, light, soles and one motor per joint to a spec, in place.

    The soles and the floor are the only geoms that touch. Joints with an effort limit get a motor
    of that limit; joints without one stay passive. Raises `RobotError` for an unknown sole body.
    """
    for geom in spec.geoms:
        geom.contype, geom.conaffinity, geom.group = 0, 0, 2
    for foot, sole in soles.items():
        body = spec.body(sole.body)
        if body is None:
            raise RobotError(
                f"the {foot} sole names the body '{sole.body}', which the model lacks; "
                f"it has {', '.join(b.name for b in spec.bodies[1:])}"
            )
        x, y, z = sole.center
        body.add_site(name=sole_name(foot), pos=sole.center, group=4)
        body.add_geom(
            name=sole_name(foot),
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=(sole.size[0] / 2, sole.size[1] / 2, SOLE_THICKNESS / 2),
            pos=(x, y, z + SOLE_THICKNESS / 2),
            mass=0.0,
            contype=1,
            conaffinity=2,
            condim=3,
            group=3,
        )
    for foot in soles:
        add_wrench_sensor(spec, sole_name(foot))
    floor(spec)
    for joint in spec.joints:
        low, high = joint.actfrcrange
        if joint.type != mujoco.mjtJoint.mjJNT_FREE and high > low:
            motor = spec.add_actuator(name=joint.name, target=joint.name)
            motor.trntype = mujoco.mjtTrn.mjTRN_JOINT
            motor.set_to_motor()
            motor.ctrlrange, motor.ctrllimited = (low, high), 1


def floor(spec: mujoco.MjSpec) -> None:
    """Add the floor plane at z = 0, its chequered look and a light."""
    spec.add_texture(
        name="floor",
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_CHECKER,
        rgb1=(0.82, 0.85, 0.88),
        rgb2=(0.70, 0.74, 0.79),
        width=256,
        height=256,
    )
    material = spec.add_material(name="floor", texrepeat=(2, 2), texuniform=True)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "floor"
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=(0, 0, 0.05),
        material="floor",
        contype=2,
        conaffinity=1,
        condim=3,
    )
    spec.worldbody.add_light(
        name="sun", type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, pos=(0, 0, 4), dir=(0.3, 0.4, -1)
    )
