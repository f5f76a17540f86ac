"""The plot of a comparison: each output over its reference, each input, all laws in one colour."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.files import whole_file
from preview_walk.preview.checks import require_type
from preview_walk.preview.compare import Comparison
from preview_walk.preview.limits import input_limits
from preview_walk.types import Array

COLOURS = {
    "LQR": "#E69F00",
    "LQI": "#009E73",
    "preview": "#0072B2",
    "MPC": "#D55E00",
    "Wieber": "#CC79A7",
}
"""Okabe and Ito's palette: told apart with any common colour vision, and in grey."""

WIDTHS = {"LQR": 3.0, "LQI": 1.2, "preview": 3.0, "MPC": 1.2, "Wieber": 1.2}
"""Laws that often coincide are drawn thin over thick."""


def plot_comparison(comparison: Comparison, path: str | os.PathLike[str]) -> Path:
    """Draw outputs and inputs of all laws over time.

    Args:
        comparison: From `compare`.
        path: The file to write; its suffix names the format.

    Returns:
        The path written.

    Raises:
        InvalidInput: If it is no comparison, or the suffix not that of a picture.
        OutputError: If the file cannot be written.

    """
    require_type("comparison", comparison, Comparison)
    plant, r = comparison.design.plant, comparison.reference
    p, m = len(plant.C), plant.B.shape[1]
    figure = Figure(figsize=(9.0, 1.0 + 2.3 * (p + m)), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(p + m, 1, sharex=True, squeeze=False)[:, 0]
    t: Array = comparison.design.dt * np.arange(len(r), dtype=np.float64)
    _draw_outputs(axes[:p].tolist(), t, comparison)
    _draw_inputs(axes[p:].tolist(), t, comparison)
    for axis in axes:
        axis.grid(True, color="0.9", linewidth=0.6)
        axis.spines[["top", "right"]].set_visible(False)
    counted = plant.dt is True
    axes[-1].set_xlabel("sample" if counted else "time [s]")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=6,
                  frameon=False)  # fmt: skip
    return save(figure, path)


def _draw_outputs(axes: Sequence[Axes], t: Array, comparison: Comparison) -> None:
    """Draw the outputs of all laws over the times t (M,), s, beside reference and limits."""
    r, limits = comparison.reference, comparison.limits
    sides = limits.extent(len(r), len(axes))
    for row, (axis, name) in enumerate(zip(axes, comparison.design.plant.outputs, strict=True)):
        axis.plot(t, r[:, row], color="0.3", linewidth=1.0, linestyle="--", label="reference")
        for result in comparison.results:
            axis.plot(t, result.run.y[:, row], label=result.name, **_style(result.name))
        _limit_lines(axis, t, [side[:, row] for side in sides])
        axis.set_ylabel(name)


def _draw_inputs(axes: Sequence[Axes], t: Array, comparison: Comparison) -> None:
    """Draw the inputs of all laws, held over each sample, beside their limits."""
    plant, limits = comparison.design.plant, comparison.limits
    sides = input_limits(limits.u_min, limits.u_max, plant.B.shape[1])
    for row, (axis, name) in enumerate(zip(axes, plant.inputs, strict=True)):
        for result in comparison.results:
            axis.step(t, result.run.u[:, row], where="post", **_style(result.name))
        _limit_lines(axis, t, [np.full(len(t), side[row]) for side in sides])
        axis.set_ylabel(name)


def _style(law: str) -> dict[str, Any]:
    """Return how a law's line is drawn."""
    return {"color": COLOURS[law], "linewidth": WIDTHS[law]}


def save(figure: Figure, path: str | os.PathLike[str]) -> Path:
    """Write a figure, whole or not at all, in the format that the suffix names.

    Raises:
        InvalidInput: If the suffix is not that of a picture.
        OutputError: If the file cannot be written.

    """
    try:
        target = Path(path)
    except TypeError:
        raise InvalidInput(
            f"expected path to be a file name, got {shown(path)}.", argument="path"
        ) from None
    suffix, formats = target.suffix.lstrip(".").lower(), figure.canvas.get_supported_filetypes()
    if suffix not in formats:
        raise InvalidInput(
            f"expected a file name that ends in one of {', '.join(sorted(formats))}, got "
            f"'{target.name}'.",
            argument="path",
        )
    with whole_file(target) as part:
        figure.savefig(part, format=suffix, dpi=150)
    return target


def _limit_lines(axis: Axes, t: Array, sides: list[Array]) -> None:
    for side in sides:
        if np.isfinite(side).any():
            axis.plot(t, side, color="0.5", linewidth=0.8, linestyle=":")
