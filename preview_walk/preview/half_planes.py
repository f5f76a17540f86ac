"""Half-planes that outputs have to stay in, sample by sample: of boxes and of convex polygons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import real_array
from preview_walk.types import Array


class HalfPlanes(NamedTuple):
    """normals(k) y(k) <= offsets(k) at each of M samples.

    normals is (M, h, p) and offsets (M, h); a sample that has fewer than h sides has rows of
    zeros at the end, with infinite offsets.
    """

    normals: Array
    offsets: Array

    def window(self, first: int, count: int) -> HalfPlanes:
        """Return those of the samples first to first + count - 1; past the end the last hold."""
        samples = np.minimum(np.arange(first, first + count), len(self.offsets) - 1)
        return HalfPlanes(self.normals[samples], self.offsets[samples])

    def along(self, y: Array) -> Array:
        """Return normals(k) y(k) of outputs y (M, p), (M, h)."""
        return np.asarray(np.einsum("khp,kp->kh", self.normals, y))

    def outside(self, y: Array) -> float:
        """Return how far outputs y (M, p) are outside at most; 0 where they never are."""
        return float((self.along(y) - self.offsets).max(initial=0.0))


def of_box(low: Array, high: Array) -> HalfPlanes:
    """Return the half-planes low <= y <= high, each (M, p), infinite where there are none."""
    unit = np.eye(low.shape[1])
    normals = np.broadcast_to(np.vstack([unit, -unit]), (len(low), 2 * len(unit), len(unit)))
    return HalfPlanes(normals, np.hstack([high, -low]))


def both(first: HalfPlanes, second: HalfPlanes) -> HalfPlanes:
    """Return the half-planes of two sets on the same outputs."""
    return HalfPlanes(*(np.concatenate(parts, axis=1) for parts in zip(first, second, strict=True)))


def beside(u: HalfPlanes, y: HalfPlanes) -> HalfPlanes:
    """Return the half-planes that u and y, one after the other as [u; y], are in."""
    (count, h, m), (_, more, p) = u.normals.shape, y.normals.shape
    normals = np.zeros((count, h + more, m + p))
    normals[:, :h, :m], normals[:, h:, m:] = u.normals, y.normals
    return HalfPlanes(normals, np.hstack([u.offsets, y.offsets]))


def half_planes(polygon: ArrayLike) -> tuple[Array, Array]:
    """Return (V, 2) outward unit normals and (V,) offsets (m) of a convex polygon's sides.

    Args:
        polygon: (V, 2) vertices (m), V >= 3, in order, either way round.

    Raises:
        InvalidInput: If it is not a convex polygon with an inside.

    """
    vertices = real_array("polygon", polygon)
    flat = vertices.ndim == 2 and vertices.shape[1] == 2 and len(vertices) >= 3
    if not (flat and np.isfinite(vertices).all()):
        raise InvalidInput(
            f"expected a polygon of shape (V, 2) with V >= 3, finite, got shape {vertices.shape}.",
            argument="polygon",
        )
    edges = np.roll(vertices, -1, axis=0) - vertices
    following = np.roll(edges, -1, axis=0)
    turns = edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]
    lengths = np.linalg.norm(edges, axis=1)
    if not (lengths > 0.0).all() or not ((turns > 0.0).all() or (turns < 0.0).all()):
        raise InvalidInput(
            "expected a convex polygon whose vertices are corners in order, got one that is not.",
            argument="polygon",
        )
    return sides(vertices if turns[0] > 0.0 else vertices[::-1])


def sides(polygon: Array) -> tuple[Array, Array]:
    """Return (V, 2) outward unit normals and (V,) offsets (m) of a polygon, counter-clockwise."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / lengths[:, None]
    return normals, np.einsum("vi,vi->v", normals, polygon)


def of_polygons(name: str, value: object) -> HalfPlanes:
    """Return the half-planes of convex polygons, one for each sample.

    Args:
        name: Name of the argument, for the sentence that refuses it.
        value: M polygons (V, 2) as `half_planes` takes them, of any numbers of vertices.

    Raises:
        InvalidInput: If it is no sequence, there is none, or one is not a convex polygon.

    """
    several = value.ndim > 0 if isinstance(value, np.ndarray) else isinstance(value, Sequence)
    if not several or isinstance(value, str) or len(value) < 1:  # type: ignore[arg-type]
        raise InvalidInput(
            f"expected {name} to be polygons, one for each sample, got {shown(value)}.",
            argument=name,
        )
    try:
        planes = [half_planes(polygon) for polygon in value]  # type: ignore[attr-defined]
    except InvalidInput as error:
        raise InvalidInput(str(error), argument=name) from error
    most = max(len(offsets) for _, offsets in planes)
    found = HalfPlanes(np.zeros((len(planes), most, 2)), np.full((len(planes), most), np.inf))
    for k, (normals, offsets) in enumerate(planes):
        found.normals[k, : len(offsets)], found.offsets[k, : len(offsets)] = normals, offsets
    return found
