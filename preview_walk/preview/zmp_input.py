"""The forms in which a whole ZMP reference, its times and the start of the CoM may be given."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import ComState
from preview_walk.preview.checks import real_array
from preview_walk.types import Array


def two_numbers(name: str, value: ArrayLike) -> Array:
    """Return (2,) finite numbers, one for each axis.

    Raises:
        InvalidInput: If they are not.

    """
    row = real_array(name, value, "two finite numbers")
    if row.shape != (2,) or not np.isfinite(row).all():
        raise InvalidInput(
            f"expected {name} to be two finite numbers, got {shown(value)}.", argument=name
        )
    return row


def read_zmp_reference(value: ArrayLike) -> Array:
    """Return a ZMP reference (m) as a finite array of shape (N,) or (N, 2).

    Raises:
        InvalidInput: If it is neither.

    """
    reference = real_array("zmp_ref", value)
    one_or_two = reference.ndim in (1, 2) and reference.shape[1:] in ((), (2,))
    if not one_or_two or len(reference) < 1:
        raise InvalidInput(
            f"expected zmp_ref of shape (N,) or (N, 2) with N >= 1, got {reference.shape}.",
            argument="zmp_ref",
        )
    if not np.isfinite(reference).all():
        raise InvalidInput("expected a finite zmp_ref, got NaN or infinity.", argument="zmp_ref")
    return reference


def start_rows(x0: ArrayLike | ComState | None, first: Array) -> Array:
    """Return [c, c', c'', jerk before] for each axis, (axes, 4).

    Args:
        x0: A start in any form that `PreviewController.trajectory` takes.
        first: (axes,) the first reference sample (m), where the CoM rests when x0 is None.

    Raises:
        InvalidInput: If x0 has none of these forms or is not finite.

    """
    axes = len(first)
    if isinstance(x0, ComState):
        if axes != 2:
            raise InvalidInput(
                "expected a ComState to start a zmp_ref of shape (N, 2), got one axis.",
                argument="x0",
            )
        return np.array(x0.array[:4].T)
    start = np.zeros((axes, 4))
    allowed = "a number or [c, c', c'']" if axes == 1 else "of shape (2,) or (2, 3)"
    values = first if x0 is None else real_array("x0", x0, f"finite and {allowed}")
    shapes = ((), (1,), (3,), (1, 3)) if axes == 1 else ((2,), (2, 3))
    if values.shape not in shapes or not np.isfinite(values).all():
        raise InvalidInput(
            f"expected x0 to be finite and {allowed}, got {shown(x0)}.", argument="x0"
        )
    if values.shape in ((), (1,), (2,)):
        start[:, 0] = values
    else:
        start[:, :3] = values
    return start


def check_times(t: ArrayLike, length: int, dt: float) -> None:
    """Refuse times (length,) of samples (s) that are not dt (s) apart.

    Raises:
        InvalidInput: If they are not.

    """
    times = real_array("t", t)
    if times.shape != (length,):
        raise InvalidInput(f"expected t of shape ({length},), got {times.shape}.", argument="t")
    steps = np.diff(times)
    if length > 1 and not np.abs(steps - dt).max() <= 1e-6 * dt:
        raise InvalidInput(
            f"expected zmp_ref sampled every {dt:g} s, the dt of the controller, got "
            f"samples {steps.min():g} to {steps.max():g} s apart.",
            argument="t",
        )
