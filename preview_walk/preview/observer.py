"""Observers for plants whose state is not measured: the gain L of x + L (y - C x - D u).

Both are designed by `control` for a prediction x(k|k-1) that the measurement of sample k corrects,
the form that `PreviewServo.observed` uses.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import real_array, require_type
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.weights import weight_matrix
from preview_walk.types import Array


def kalman_gain(design: PreviewDesign, process_noise: ArrayLike, output_noise: ArrayLike) -> Array:
    """Return the stationary Kalman gain (n, p) of a design's plant.

    Args:
        design: The servo whose state is to be observed.
        process_noise: (n, n) covariance of what disturbs the state in a sample; (n,) its diagonal,
            or a number.
        output_noise: (p, p) covariance of the noise of the outputs; (p,) or a number; definite.

    Raises:
        InvalidInput: If a covariance cannot be or the outputs do not show the state.

    """
    import control

    require_type("design", design, PreviewDesign)
    a, c = design.plant.A, design.plant.C
    process = weight_matrix("process_noise", process_noise, len(a))
    output = weight_matrix("output_noise", output_noise, len(c), definite=True)
    try:
        with np.errstate(all="ignore"):
            _, p, poles = control.dlqe(a, np.eye(len(a)), c, process, output)
            gain: Array = np.linalg.solve(c @ p @ c.T + output, c @ p).T
    except (np.linalg.LinAlgError, ValueError, TypeError) as error:
        raise InvalidInput(
            "expected outputs and noises that make a Kalman filter, got: "
            f"{str(error).rstrip('.')}.",
            argument="process_noise",
        ) from error
    if not (np.isfinite(gain).all() and np.abs(poles).max() < 1.0):
        raise InvalidInput(
            "expected outputs and noises that make a stable Kalman filter, got a mode at "
            f"{np.abs(poles).max():.6f}.",
            argument="process_noise",
        )
    return gain


def luenberger_gain(design: PreviewDesign, poles: ArrayLike) -> Array:
    """Return the gain (n, p) with which the observer's error decays with given poles.

    Args:
        design: The servo whose state is to be observed.
        poles: (n,) poles inside the unit circle, complex ones in pairs; none more often than there
            are outputs.

    Raises:
        InvalidInput: If the poles cannot be or the outputs do not show the state.

    """
    import control

    require_type("design", design, PreviewDesign)
    a, c = design.plant.A, design.plant.C
    try:
        wanted = np.atleast_1d(np.asarray(poles))
    except ValueError:
        wanted = np.zeros(0)
    if wanted.dtype.kind != "c":
        wanted = np.atleast_1d(real_array("poles", poles))
    if wanted.shape != (len(a),) or not np.isfinite(wanted).all() or np.abs(wanted).max() >= 1.0:
        raise InvalidInput(
            f"expected {len(a)} poles inside the unit circle, got {shown(poles)}.", argument="poles"
        )
    try:
        # (I - L C) A = A - L (C A): the error after the correction.
        gain: Array = np.asarray(control.place(a.T, (c @ a).T, wanted)).T
    except (np.linalg.LinAlgError, ValueError, TypeError) as error:
        raise InvalidInput(
            f"expected poles that the outputs can place, got: {str(error).rstrip('.')}.",
            argument="poles",
        ) from error
    return gain
