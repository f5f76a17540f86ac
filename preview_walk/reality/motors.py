"""Motors as a value: what becomes of a torque that is asked for."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.reality.checking import Checked


@dataclass(frozen=True)
class Motors(Checked):
    """Motors with their drives and gears.

    Attributes:
        delay: from a torque asked for to the one that the drive begins to make, s.
        bandwidth: of the drive's first-order lag, Hz; 0 for one without.
        dry_friction: of a joint, share of its motor's largest torque; it acts against any motion,
            and holds a joint at rest.
        viscous_friction: of a joint, N·m·s/rad as share of the largest torque in N·m, so that
            0.01 takes 1 % of the torque at 1 rad/s.
        error: standard deviation of a motor's constant, share of the torque.
        ripple: amplitude of the torque's waves over the angle, share of the largest torque.
        rotor_inertia: of a rotor as its joint feels it through the gear, kg·m^2 for each N·m of the
            largest torque. The controller's model has it too; a joint whose model has more armature
            keeps that.
        strength: share of its largest torque that a motor still has.
    """

    delay: float = 0.0
    bandwidth: float = 0.0
    dry_friction: float = 0.0
    viscous_friction: float = 0.0
    error: float = 0.0
    ripple: float = 0.0
    rotor_inertia: float = 0.0
    strength: float = 1.0

    @property
    def lag(self) -> float:
        """Time (s) by which a torque comes late altogether."""
        return self.delay + (0.0 if self.bandwidth == 0.0 else lag_of(self.bandwidth))


def lag_of(bandwidth: float) -> float:
    """Return the time constant (s) of a first-order lag of this bandwidth (Hz)."""
    return 1.0 / (6.283185307179586 * bandwidth)
