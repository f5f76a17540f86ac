"""The weights and gains of the tracker: one set for every robot."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class TrackingGains:
    """Weights of the QP's tasks and frequencies of their feedback.

    Weights multiply squared accelerations (m^2/s^4 or rad^2/s^4), so they are the same for every
    robot; a frequency f (rad/s) is a critically damped spring, stiffness f^2 and damping 2 f.

    - `dcm`: rate (1/s) at which the error of the DCM decays; CoM height: `height` (rad/s).
    - `com_weight`, `foot_weight`, `torso_weight`, `momentum_weight`: of these tasks.
    - `posture_weight`: of every joint's posture; `trunk_weight`: of the joints between pelvis and
      torso.
    - `wrench_weight`: regularises the contact wrenches (per (100 N)^2).
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
