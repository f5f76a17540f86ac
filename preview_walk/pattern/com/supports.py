"""The support polygons of a sampled plan, as the half-planes that the ZMP must stay in."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import Sole, support_polygon
from preview_walk.pattern.zmp_reference import ZMP_MARGIN
from preview_walk.preview.half_planes import sides
from preview_walk.types import FEET, Array


class Supports:
    """Where the ZMP may be at the samples of a plan, `ZMP_MARGIN` within the soles' edges."""

    def __init__(self, plan: FootstepPlan, sole: Sole, times: Array) -> None:
        """Note which soles stand at the times (M,), s."""
        self._plan = plan
        # A sole narrower than four margins keeps half of its width.
        self._sole = Sole(
            *(max(half - ZMP_MARGIN, 0.5 * half) for half in (sole.half_length, sole.half_width))
        )
        self._times = times
        self._stands = np.ones((len(times), 2), dtype=bool)
        for step in plan.steps:
            first, last = np.searchsorted(times, (step.lift, step.land))
            self._stands[first:last, FEET.index(step.foot)] = False
        self._known: dict[tuple[bool, bool, int], tuple[Array, Array]] = {}
        self._landed = np.searchsorted([step.land for step in plan.steps], times, side="right")

    def around(self, samples: NDArray[np.intp], reach: int) -> list[tuple[Array, Array]]:
        """Return outward normals (V, 2) and offsets (V,) in m of the support of each sample.

        A sole counts that stands from `reach` samples before to as many after, so that a ZMP that
        runs straight between samples `reach` apart is on the soles all the way; where there is no
        such sole, in a double support as short as that, those count that stand at the sample.
        """
        last = len(self._times) - 1
        near = [np.clip(samples + shift, 0, last) for shift in (-reach, 0, reach)]
        steady = np.logical_and.reduce([self._stands[index] for index in near])
        now = self._stands[near[1]]
        stands = np.where(steady.any(axis=1)[:, None], steady, now)
        return [self._sides(int(i), row) for i, row in zip(near[1], stands.tolist(), strict=True)]

    def _sides(self, sample: int, stands: list[bool]) -> tuple[Array, Array]:
        """Return the half-planes of the standing soles at a sample, made once for each support."""
        key = (stands[0], stands[1], int(self._landed[sample]))
        if key not in self._known:
            t = float(self._times[sample])
            soles = [self._plan.sole(f, t) for f, down in zip(FEET, stands, strict=True) if down]
            self._known[key] = sides(support_polygon(soles, self._sole))
        return self._known[key]
