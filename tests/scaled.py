"""A robot of another size: lengths by a factor, masses by its cube, torques by its fourth power.

So it is the same robot to whom gravity is the same: in time scaled by the root of the factor, all
that it does is alike.
"""

from __future__ import annotations

from pathlib import Path

import mujoco

MODEL = Path(__file__).parents[1] / "models" / "humanoid-walker.xml"


def scaled_walker(k: float) -> mujoco.MjModel:
    """Return the walking lab's humanoid, `k` times as long; its legs are 0.85 m at 1."""
    spec = mujoco.MjSpec.from_file(str(MODEL))
    for body in spec.bodies[1:]:
        body.pos = body.pos * k
        body.ipos = body.ipos * k
        body.mass *= k**3
        body.inertia = body.inertia * k**5
        body.fullinertia = body.fullinertia * k**5
    for geom in spec.geoms:
        if geom.type != mujoco.mjtGeom.mjGEOM_PLANE:
            geom.size, geom.pos, geom.fromto = geom.size * k, geom.pos * k, geom.fromto * k
            geom.mass *= k**3
    for joint in spec.joints:
        joint.pos = joint.pos * k
        joint.damping = joint.damping * k**4.5
        joint.armature *= k**5
    for site in spec.sites:
        site.pos, site.size = site.pos * k, site.size * k
    for actuator in spec.actuators:
        actuator.forcerange = actuator.forcerange * k**4
        actuator.ctrlrange = actuator.ctrlrange * k**4
    return spec.compile()
