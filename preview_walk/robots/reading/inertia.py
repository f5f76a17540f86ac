"""Masses and inertias that a physics engine can use, or a sentence that says why not."""

from __future__ import annotations

import numpy as np

from preview_walk.errors import RobotError
from preview_walk.types import Array

MASSLESS = (1e-3, 1e-5)
"""Mass (kg) and principal inertias (kg·m²) given to a moving body that has none."""

DENSITY = 1000.0
"""Density (kg/m³) of the solid ball whose inertia a moving point mass is given."""

NO_MASS = "no mass (1 g assumed)"
NO_INERTIA = "mass but no inertia (a solid ball's assumed)"
NOT_SOLID = "an inertia that no solid has (the small moments raised)"


def usable_inertia(
    body: str, mass: float, inertia: Array, moving: bool
) -> tuple[float, Array, Array, str]:
    """Return a mass and an inertia that an engine can use.

    Principal inertias that no solid can have (one larger than the sum of the others) are raised.

    Args:
        body: its name.
        mass: in kg.
        inertia: (3, 3) about the centre of mass, kg·m².
        moving: whether the body hangs on a joint of its own: it then needs a mass and an inertia.

    Returns:
        Mass (kg), principal inertias (3,), their axes (3, 3), and what was wrong, or "".

    Raises:
        RobotError: a mass or an inertia that is not a number or is negative.
    """
    if not (np.isfinite(mass) and np.isfinite(inertia).all()):
        diagonal = ", ".join(f"{moment:g}" for moment in np.diag(inertia))
        raise RobotError(
            f"the body '{body}' has the mass {mass:g} kg and the moments of inertia "
            f"({diagonal}) kg·m²; expected finite numbers"
        )
    if mass < 0.0:
        raise RobotError(
            f"the body '{body}' has the mass {mass:g} kg; expected zero or a positive mass"
        )
    moments, axes = np.linalg.eigh(inertia)
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] = -axes[:, 0]
    if moments[0] < -1e-9 - 1e-6 * abs(moments[2]):
        raise RobotError(
            f"the body '{body}' has the principal inertia {moments[0]:.4g} kg·m²; "
            "expected zero or positive inertias"
        )
    if mass == 0.0:
        if not moving:
            return 0.0, np.zeros(3), np.eye(3), ""
        return MASSLESS[0], np.full(3, MASSLESS[1]), np.eye(3), NO_MASS
    if moments[0] < 1e-9 * mass:
        if not moving:
            return mass, np.zeros(3), np.eye(3), ""
        radius = (3.0 * mass / (4.0 * np.pi * DENSITY)) ** (1 / 3)
        return mass, np.full(3, 0.4 * mass * radius**2), np.eye(3), NO_INERTIA
    missing = moments[2] - moments[0] - moments[1]
    if missing > 0.0:
        moments[:2] += 0.5 * missing * (1.0 + 1e-9)
        return mass, moments, axes, NOT_SOLID if missing > 1e-3 * moments[2] else ""
    return mass, moments, axes, ""
