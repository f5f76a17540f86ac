"""Ground as a grid of heights: from an array, a file, a function, or random and smooth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import gaussian_filter

from preview_walk.arguments import (
    count_of,
    finite_number,
    function_of,
    number_from_zero,
    positive_number,
    real_array,
)
from preview_walk.errors import InvalidInput
from preview_walk.terrain.slabs import DEPTH
from preview_walk.types import Array

MOST_HEIGHTS = 4_000_000
"""A field has at most so many heights: 80 m x 80 m at 4 cm."""

SPACING = 0.04
"""Default distance (m) of the heights: some five of them under a sole's length."""

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff")
"""Files that are read as pictures: black is low, white is high."""


@dataclass(frozen=True, eq=False)
class HeightField:
    """Heights on a grid, with two triangles in every cell; beside it is a floor far below.

    Attributes:
        heights: (I, J), m; heights[i, j] is at x + i spacing, y + j spacing. Read-only.
        spacing: of the grid, m.
        x, y: where heights[0, 0] is, world, m.

    Raises:
        InvalidInput: fewer than two heights along an axis, too many, or one that is not finite.
    """

    heights: Array
    spacing: float = SPACING
    x: float = -1.0
    y: float = -2.0

    def __post_init__(self) -> None:
        """Check the numbers and take the heights as one's own."""
        heights = np.array(real_array(self.heights, "heights", "an array (I, J)"))
        if heights.ndim != 2 or min(heights.shape) < 2 or heights.size > MOST_HEIGHTS:
            raise InvalidInput(
                "heights must be of shape (I, J), at least 2 along each axis and at most "
                f"{MOST_HEIGHTS} in all, got {heights.shape}.",
                "heights",
            )
        if not np.isfinite(heights).all():
            raise InvalidInput("heights must be finite.", "heights")
        heights.setflags(write=False)
        object.__setattr__(self, "heights", heights)
        positive_number(self.spacing, "spacing", "m")
        for name in ("x", "y"):
            finite_number(getattr(self, name), name, "m")

    def __repr__(self) -> str:
        rows, columns = self.heights.shape
        low, high = float(self.heights.min()), float(self.heights.max())
        return (
            f"HeightField({rows} x {columns}, {self.spacing:g} m apart, {low:.3f} to {high:.3f} m)"
        )

    @classmethod
    def of(
        cls,
        function: Callable[[Array, Array], ArrayLike],
        x: tuple[float, float] = (-1.0, 10.0),
        y: tuple[float, float] = (-2.0, 2.0),
        spacing: float = SPACING,
    ) -> HeightField:
        """Return the field of a function of one's own.

        Args:
            function: takes x and y (I, J), m, and returns heights (I, J), m.
            x: from where to where along the world's x, m.
            y: from where to where along the world's y, m.
            spacing: of the grid, m.

        Raises:
            InvalidInput: the function returns something else, or there is nothing in between.
        """
        if function_of(function, "function") is None:
            raise InvalidInput("function must be a function of x and y, got None.", "function")
        step = positive_number(spacing, "spacing", "m")
        axes = []
        for name, (low, high) in (("x", x), ("y", y)):
            low, high = finite_number(low, name, "m"), finite_number(high, name, "m")
            count = (high - low) / step
            if not 1.0 <= count < MOST_HEIGHTS:
                raise InvalidInput(
                    f"{name} must go up by at least the spacing of {step} m, got {low}, {high}.",
                    name,
                )
            axes.append(low + step * np.arange(int(count) + 1))
        across, aside = np.meshgrid(*axes, indexing="ij")
        heights = real_array(function(across, aside), "function", "heights (I, J) in m")
        if heights.shape not in ((), across.shape):
            raise InvalidInput(
                f"function must return heights of the shape {across.shape}, got {heights.shape}.",
                "function",
            )
        heights = np.broadcast_to(heights, across.shape)
        return cls(heights, step, float(axes[0][0]), float(axes[1][0]))

    @property
    def floor(self) -> float:
        """Height (m) of the level floor beside the field."""
        return float(self.heights.min()) - DEPTH

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the height (m) at x and y (world, m); see `Ground`."""
        heights, _, _ = self.planes(np.asarray(x), np.asarray(y))
        return heights

    def planes(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """Return the planes of the triangles at x and y (N,), world, m.

        Their heights there, m, and what they rise per m along the world's x and y, (N,) each.
        """
        corner, ahead, left, (u, w), inside = self._cells(x, y)
        heights = np.where(inside, corner + ahead * u + left * w, self.floor)
        per_metre = np.where(inside, 1.0 / self.spacing, 0.0)
        return heights, ahead * per_metre, left * per_metre

    def normal(self, x: float, y: float) -> Array:
        """Return the unit normal (3,) of the triangle at x, y (world, m)."""
        _, ahead, left = self.planes(np.array([x]), np.array([y]))
        normal = np.array((-float(ahead[0]), -float(left[0]), 1.0))
        normal /= np.linalg.norm(normal)
        return normal

    def _cells(
        self, x: ArrayLike, y: ArrayLike
    ) -> tuple[Array, Array, Array, tuple[Array, Array], Array]:
        """Return the planes of the triangles at x and y, the places in their cells, and if inside.

        A plane is its height at the cell's first corner and what it rises in a cell along x and y.
        """
        u = (np.asarray(x, dtype=np.float64) - self.x) / self.spacing
        w = (np.asarray(y, dtype=np.float64) - self.y) / self.spacing
        u, w = np.broadcast_arrays(u, w)
        rows, columns = self.heights.shape
        with np.errstate(invalid="ignore"):
            inside = (u >= 0.0) & (u <= rows - 1) & (w >= 0.0) & (w <= columns - 1)
        i = np.where(inside, u, 0.0).astype(int).clip(0, rows - 2)
        j = np.where(inside, w, 0.0).astype(int).clip(0, columns - 2)
        u, w = u - i, w - j
        a, b = self.heights[i, j], self.heights[i + 1, j]
        c, d = self.heights[i, j + 1], self.heights[i + 1, j + 1]
        first = u >= w  # MuJoCo cuts a cell from its first corner to its last
        ahead, left = np.where(first, b - a, d - c), np.where(first, d - b, c - a)
        return a, ahead, left, (u, w), inside


def height_field(
    file: str | Path, length: float = 10.0, height: float = 0.2, begin: float = -1.0
) -> HeightField:
    """Return the ground of a file: a picture, or an array as .npy, .csv or .txt.

    It is as long as wanted and as wide as its shape says, its middle line along x. A picture's left
    edge is where it begins.

    Args:
        file: its path. An array has x down its rows and y along its columns, in m.
        length: along x, m.
        height: of a picture's white above its black, m; arrays have theirs.
        begin: where it begins along x, m.

    Raises:
        InvalidInput: it cannot be read, or holds no heights.
    """
    path = Path(file)
    length = positive_number(length, "length", "m")
    try:
        if path.suffix.lower() in PICTURES:
            from matplotlib.image import imread

            picture = np.asarray(imread(path), dtype=np.float64)
            picture = picture[..., :3].mean(axis=-1) if picture.ndim == 3 else picture
            picture /= 255.0 if picture.max(initial=0.0) > 1.0 else 1.0
            heights = finite_number(height, "height", "m") * picture[::-1].T
        elif path.suffix.lower() == ".npy":
            heights = np.load(path, allow_pickle=False)
        else:
            lines = path.read_text().splitlines()
            heights = np.array([_numbers(line) for line in lines if line.strip()])
    except InvalidInput:
        raise
    except (OSError, ValueError, SyntaxError, MemoryError, EOFError) as error:
        raise InvalidInput(f"the height field '{path}' cannot be read: {error}.", "file") from None
    if np.ndim(heights) != 2 or min(np.shape(heights)) < 2:
        raise InvalidInput(
            f"the height field '{path}' must hold at least 2 x 2 heights, "
            f"got the shape {np.shape(heights)}.",
            "file",
        )
    spacing = length / (len(heights) - 1)
    return HeightField(heights, spacing, begin, -0.5 * spacing * (heights.shape[1] - 1))


def _numbers(line: str) -> list[float]:
    """Return the numbers of a line, between commas or blanks."""
    return [float(number) for number in line.replace(",", " ").split()]


def rough(
    height: float = 0.04,
    size: float = 0.5,
    length: float = 10.0,
    width: float = 3.0,
    seed: int = 0,
    *,
    begin: float = 0.5,
) -> HeightField:
    """Return smooth random ground.

    Args:
        height: root mean square of its heights, m.
        size: over which heights are alike (standard deviation of the smoothing), m.
        length: along x, m.
        width: from the right edge to the left, m.
        seed: the same seed gives the same ground.
        begin: where the level place around the origin ends, m; it is rough from 0.5 m later on.
    """
    height, size = number_from_zero(height, "height", "m"), positive_number(size, "size", "m")
    length, width = positive_number(length, "length", "m"), positive_number(width, "width", "m")
    begin = positive_number(begin, "begin", "m")
    shape = (round((1.0 + begin + length) / SPACING) + 1, round(width / SPACING) + 1)
    if shape[0] * shape[1] > MOST_HEIGHTS or size > 100.0 * max(length, width):
        raise InvalidInput(
            f"rough ground has at most {MOST_HEIGHTS} heights {SPACING} m apart, "
            f"got {length} m x {width} m.",
            "length",
        )
    random = np.random.default_rng(count_of(seed, "seed"))
    heights = gaussian_filter(random.standard_normal(shape), size / SPACING, mode="wrap")
    heights *= height / max(float(heights.std()), 1e-300)
    x = -1.0 + SPACING * np.arange(shape[0])
    u = ((x - begin - SPACING) / 0.5).clip(0.0, 1.0)
    heights *= (u * u * (3.0 - 2.0 * u))[:, None]
    return HeightField(heights, SPACING, -1.0, -0.5 * SPACING * (shape[1] - 1))
