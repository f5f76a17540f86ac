"""The weights and gains of the tracker: one set for every robot."""

from __future__ import annotations

from dataclasses import dataclass, fields

from preview_walk.arguments import number_from_zero, positive_number


@dataclass(frozen=True)
class TrackingGains:
    """Weights of the QP's tasks and rates of their feedback.

    Weights multiply squared accelerations (m^2/s^4 or rad^2/s^4), so they are the same for every
    robot. A frequency f (rad/s) is a critically damped spring, stiffness f^2 and damping 2 f.

    Attributes:
        dcm: rate at which an error of the DCM decays, 1/s.
        height: frequency of the CoM's height, rad/s.
        foot: frequency of a swinging sole's pose, rad/s.
        torso: frequency of the torso's orientation, rad/s.
        posture: frequency of the joints' posture, rad/s.
        momentum: rate at which the angular momentum decays, 1/s.
        com_weight: of the CoM's acceleration.
        foot_weight: of a swinging sole's acceleration.
        torso_weight: of the torso's angular acceleration.
        posture_weight: of every joint's posture.
        trunk_weight: of the posture of the joints between pelvis and torso.
        momentum_weight: of the angular momentum's rate, 1/(N·m)^2; 0 leaves the task out.
        wrench_weight: of the contact wrenches, per (100 N)^2; it regularises them.

    Raises:
        InvalidInput: a value is not finite and > 0 (>= 0 for `momentum_weight`).
    """

    dcm: float = 20.0
    height: float = 10.0
    foot: float = 25.0
    torso: float = 12.0
    posture: float = 8.0
    momentum: float = 5.0
    com_weight: float = 100.0
    foot_weight: float = 100.0
    torso_weight: float = 2.0
    posture_weight: float = 0.002
    trunk_weight: float = 0.2
    momentum_weight: float = 0.0
    wrench_weight: float = 1e-3

    def __post_init__(self) -> None:
        """Check the values, and take them as plain numbers."""
        for gain in fields(self):
            read = number_from_zero if gain.name == "momentum_weight" else positive_number
            unit = "" if "weight" in gain.name else "rad/s"
            object.__setattr__(self, gain.name, read(getattr(self, gain.name), gain.name, unit))
