"""Grounds by name: slopes, stairs, ramps, blocks, stepping stones.

All begin with a level place at height 0 around the origin, on which a robot can stand facing x.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import radians, tan

import numpy as np

from preview_walk.arguments import count_of, finite_number, number_from_zero, positive_number
from preview_walk.errors import InvalidInput
from preview_walk.terrain.slabs import DEPTH, STEEPEST, Slab, SlabGround

BEGIN = 0.5
"""Default distance (m) of the first edge from the origin."""

WIDTH = 3.0
"""Default extent (m) of a ground from its right edge to its left."""

END = 3.0
"""Length (m) of the level place after the last piece."""


@dataclass(frozen=True)
class Piece:
    """A stretch of a path: a step, then a plane.

    Attributes:
        length: along x on the level, m.
        step: height of its beginning above the end of the piece before, m.
        degrees: how steeply it rises along x.
        bank: how steeply it rises to the left, degrees.
    """

    length: float
    step: float = 0.0
    degrees: float = 0.0
    bank: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        positive_number(self.length, "length", "m")
        finite_number(self.step, "step", "m")
        for name in ("degrees", "bank"):
            steep = finite_number(getattr(self, name), name, "degrees")
            if abs(radians(steep)) > STEEPEST:
                raise InvalidInput(
                    f"{name} must be at most {np.degrees(STEEPEST):.0f}, got {steep}.", name
                )


def path(pieces: Iterable[Piece], begin: float = BEGIN, width: float = WIDTH) -> SlabGround:
    """Return the ground that goes along x piece by piece, level before them and after.

    Args:
        pieces: one after the other.
        begin: where the first one begins, m.
        width: from the right edge to the left, m.
    """
    half = 0.5 * positive_number(width, "width", "m")
    x, z = positive_number(begin, "begin", "m"), 0.0
    slabs = [Slab(0.5 * (x - END), 0.0, 0.0, 0.5 * (x + END), half)]
    for piece in (*pieces, Piece(END)):
        z += piece.step
        rise = tan(radians(piece.degrees)) * piece.length
        slabs.append(
            Slab(
                x + 0.5 * piece.length,
                0.0,
                z + 0.5 * rise,
                0.5 * piece.length,
                half,
                pitch=-radians(piece.degrees),
                roll=radians(piece.bank),
            )
        )
        x, z = x + piece.length, z + rise
    return SlabGround(tuple(slabs), min(slab.z for slab in slabs) - DEPTH)


def slope(
    degrees: float = 8.0, bank: float = 0.0, length: float = 10.0, begin: float = BEGIN
) -> SlabGround:
    """Return a plane that rises along x (degrees) and to the left (bank, degrees).

    Args:
        degrees: below 0 it goes down.
        bank: below 0 it goes down to the left.
        length: along x on the level, m; after it the ground is level.
        begin: where it begins, m.
    """
    return path([Piece(length, degrees=degrees, bank=bank)], begin)


def stairs(
    rise: float = 0.15,
    tread: float = 0.28,
    count: int = 6,
    back: bool = False,
    begin: float = BEGIN,
) -> SlabGround:
    """Return stairs along x.

    Args:
        rise: height of a step, m; below 0 they go down.
        tread: depth of a step, m.
        count: number of steps.
        back: whether as many steps lead back to height 0, after a landing of 1 m.
        begin: where the first one begins, m.
    """
    finite_number(rise, "rise", "m")
    positive_number(tread, "tread", "m")
    up = [Piece(tread, step=rise)] * count_of(count, "count")
    if not back or not up:
        return path(up, begin)
    down = [Piece(tread, step=-rise)] * (count - 1)
    return path([*up[:-1], Piece(1.0, step=rise), *down, Piece(END, step=-rise)], begin)


def ramps(
    degrees: float = 8.0, length: float = 1.0, count: int = 4, begin: float = BEGIN
) -> SlabGround:
    """Return ramps in a row, up and down in turns.

    Args:
        degrees: how steep they are.
        length: of each on the level, m.
        count: number of ramps.
        begin: where the first one begins, m.
    """
    turns = range(count_of(count, "count"))
    return path([Piece(length, degrees=degrees if k % 2 == 0 else -degrees) for k in turns], begin)


def blocks(
    height: float = 0.03,
    size: float = 0.3,
    length: float = 10.0,
    seed: int = 0,
    begin: float = BEGIN,
) -> SlabGround:
    """Return a field of square blocks of random heights, uniform from -height to height.

    Args:
        height: m.
        size: of a block, m.
        length: of the field along x, m.
        seed: the same seed gives the same field.
        begin: where the first row begins, m.
    """
    number_from_zero(height, "height", "m")
    positive_number(size, "size", "m")
    rows = max(1, round(positive_number(length, "length", "m") / size))
    random = np.random.default_rng(count_of(seed, "seed"))
    level = path([], begin)
    slabs = _grid(random.uniform(-height, height, (rows, round(WIDTH / size))), size, begin)
    after = begin + rows * size + 0.5 * END
    ends = (level.slabs[0], Slab(after, 0.0, 0.0, 0.5 * END, 0.5 * WIDTH))
    return SlabGround((*slabs, *ends), -height - DEPTH)


def _grid(heights: np.ndarray, size: float, begin: float) -> Iterator[Slab]:
    """Yield square slabs of these heights (rows along x, columns from the right), m."""
    rows, columns = heights.shape
    for i in range(rows):
        for j in range(columns):
            x, y = begin + (i + 0.5) * size, (j + 0.5 - 0.5 * columns) * size
            yield Slab(x, y, float(heights[i, j]), 0.5 * size, 0.5 * size)


def stepping_stones(
    size: float = 0.3, gap: float = 0.1, count: int = 8, width: float = 0.3, begin: float = BEGIN
) -> SlabGround:
    """Return two rows of square stones over a pit, one under each foot.

    Args:
        size: of a stone, m.
        gap: from one stone to the next, m.
        count: number of stones in a row.
        width: between the middles of the two rows, m.
        begin: where the first ones begin, m.
    """
    positive_number(size, "size", "m")
    number_from_zero(gap, "gap", "m")
    level = path([], begin)
    stones = [
        Slab(
            begin + gap + 0.5 * size + k * (size + gap), side * 0.5 * width, 0.0, *2 * (0.5 * size,)
        )
        for k in range(count_of(count, "count"))
        for side in (1.0, -1.0)
    ]
    last = begin + count * (size + gap) + gap + 0.5 * END
    return SlabGround(
        (level.slabs[0], *stones, Slab(last, 0.0, 0.0, 0.5 * END, 0.5 * WIDTH)), -DEPTH
    )
