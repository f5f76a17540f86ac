"""The lab's names are the law: with them alone a loop comes to the controller's trajectory."""

from __future__ import annotations

import numpy as np
import pytest

import preview_walk as pw


def test_a_loop_by_the_labs_names_is_the_controllers_trajectory() -> None:
    preview = pw.PreviewController(z_c=0.8, dt=0.01)
    reference = np.where(np.arange(300) < 150, 0.0, 0.1)
    com, velocity = preview.generate_com_trajectory(reference)
    n, ahead = len(preview.G_preview), np.append(reference, np.full(500, reference[-1]))
    x, last, u, found = np.zeros((3, 1)), np.zeros((3, 1)), 0.0, []
    for k in range(300):
        found.append(x[:2, 0])
        error = float(preview.C[0] @ x[:, 0]) - reference[k]
        z = np.vstack(([[error]], x - last))
        steps = np.diff(ahead[k : k + n + 1])
        u -= float(preview.K[0] @ z[:, 0]) + float(preview.G_preview @ steps)
        x, last = preview.A @ x + preview.B * u, x
    assert np.array(found) == pytest.approx(np.column_stack((com, velocity)), abs=1e-10)


def test_the_pendulums_numbers() -> None:
    preview = pw.PreviewController(z_c=0.8)
    assert preview.g == 9.81
    assert preview.omega == pytest.approx((9.81 / 0.8) ** 0.5)
    with pytest.raises(ValueError, match="read-only"):
        preview.K[0, 0] = 1.0
