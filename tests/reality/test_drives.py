"""Motors as they are: their rotors in both engines."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin

import preview_walk as pw
from preview_walk.reality.drives import with_rotors
from preview_walk.robots.robot import Robot
from preview_walk.simulation.real_world import RealWorld


def test_a_rotor_is_turned_by_its_joint_alone(talos: Robot) -> None:
    """The mass matrix gains the rotors on its diagonal and nothing else, in both engines."""
    turned, inertia = with_rotors(talos, 1e-3), 1e-3 * talos.effort
    own = np.zeros((2, talos.pin.nv, talos.pin.nv))
    for mass, robot in zip(own, (talos, turned), strict=True):
        mass[:] = np.triu(pin.crba(robot.pin, robot.pin.createData(), robot.posture))
    added = np.concatenate([np.zeros(6), inertia])
    np.testing.assert_allclose(own[1] - own[0], np.diag(added), atol=1e-12)
    np.testing.assert_allclose(turned.mj.dof_armature, added, atol=1e-12)
    assert not talos.mj.dof_armature.any()
    assert not talos.pin.armature.any()


def test_a_model_with_more_armature_keeps_it(talos: Robot) -> None:
    much = with_rotors(talos, 1e-3)
    np.testing.assert_array_equal(with_rotors(much, 1e-4).mj.dof_armature, much.mj.dof_armature)
    assert with_rotors(talos, 0.0) is talos


def test_the_physics_has_the_rotors_on_any_ground(talos: Robot) -> None:
    """A model with ground is made anew, from sources that know of no rotors."""
    motors = pw.Motors(rotor_inertia=1e-3)
    for ground in (None, pw.slope(3)):
        world = RealWorld(talos, replace(pw.Realism(), motors=motors), ground=ground)
        np.testing.assert_allclose(world.model.dof_armature[6:], 1e-3 * talos.effort)
