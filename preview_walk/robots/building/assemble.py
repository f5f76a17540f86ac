"""Put a robot's spec into a world it can walk in: floor, light, box soles, torque motors."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco

from preview_walk.robots.building.contact_sensor import add_wrench_sensor
from preview_walk.robots.finding.soles import SolePatch
from preview_walk.robots.reading.urdf import quaternion
from preview_walk.types import Foot

SOLE_THICKNESS = 0.02
"""Height of the box that stands for a sole (m); its lower face is the sole plane."""


def sole_name(foot: Foot) -> str:
    """Return the name of the site and of the box geom of a sole in the assembled model."""
    return f"{foot}_sole"


def assemble(
    spec: mujoco.MjSpec, soles: Mapping[Foot, SolePatch], efforts: Mapping[str, float]
) -> None:
    """Add floor, light, soles and one motor per joint to a spec, in place.

    The soles and the floor are the only geoms that touch.

    Args:
        spec: the robot.
        soles: where the soles are.
        efforts: torque limits (N·m) of the joints that get a motor, by name; others stay passive.
    """
    for geom in spec.geoms:
        geom.contype, geom.conaffinity, geom.group = 0, 0, 2
    for foot, sole in soles.items():
        body = spec.body(sole.body)
        quat = quaternion(sole.rotation)
        body.add_site(name=sole_name(foot), pos=sole.position, quat=quat, group=4)
        body.add_geom(
            name=sole_name(foot),
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=(sole.size.half_length, sole.size.half_width, SOLE_THICKNESS / 2),
            pos=sole.position + sole.rotation[:, 2] * SOLE_THICKNESS / 2,
            quat=quat,
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
        effort = efforts.get(joint.name, 0.0)
        if joint.type != mujoco.mjtJoint.mjJNT_FREE and effort > 0.0:
            motor = spec.add_actuator(name=joint.name, target=joint.name)
            motor.trntype = mujoco.mjtTrn.mjTRN_JOINT
            motor.set_to_motor()
            motor.ctrlrange, motor.ctrllimited = (-effort, effort), 1


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
    plane = spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=(0, 0, 0.05),
        material="floor",
        contype=2,
        conaffinity=1,
        condim=3,
    )
    if hasattr(plane, "castshadow"):  # MuJoCo 3, all there is for Python 3.10, has no such switch
        plane.castshadow = False
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=(0.93, 0.95, 0.97),
        rgb2=(0.62, 0.71, 0.82),
        width=64,
        height=384,
    )
    # The sun follows the robot, because shadows are drawn only near it.
    spec.worldbody.first_body().add_light(
        name="sun",
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        mode=mujoco.mjtCamLight.mjCAMLIGHT_TRACKCOM,
        pos=(-0.6, -0.8, 2.0),
        dir=(0.3, 0.4, -1),
    )
