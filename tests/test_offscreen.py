"""Rendering without a screen: whatever was imported before, and one sentence where it can't be."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import mujoco
import numpy as np
import pytest

from preview_walk.offscreen import RenderError, off_screen

LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="EGL is Linux's way")

DRAW = """
import mujoco  # chooses a window, for MUJOCO_GL is not set
from preview_walk.offscreen import off_screen
model = mujoco.MjModel.from_xml_string(
    "<mujoco><worldbody><light pos='0 0 3'/><geom size='1'/></worldbody></mujoco>"
)
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with off_screen():
    renderer = mujoco.Renderer(model, 40, 60)
with renderer:
    renderer.update_scene(data)
    print(renderer.render().std() > 1.0)
"""


def egl() -> bool:
    """Return whether this machine has EGL at all."""
    try:
        from mujoco.egl import GLContext

        GLContext(1, 1).free()
    except Exception:
        return False
    return True


@LINUX
def test_it_draws_where_mujoco_was_imported_for_a_screen_that_is_not_there() -> None:
    if not egl():
        pytest.skip("no EGL")
    hidden = {"MUJOCO_GL", "DISPLAY", "WAYLAND_DISPLAY", "PYOPENGL_PLATFORM"}
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    done = subprocess.run(
        [sys.executable, "-c", DRAW], capture_output=True, text=True, env=environment, check=False
    )
    assert done.stdout == "True\n", done.stderr


@LINUX
def test_without_egl_and_screen_one_sentence_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setitem(sys.modules, "mujoco.egl", None)
    sentence = (
        "rendering without a screen needs OpenGL's EGL (on Debian or Ubuntu: sudo apt install "
        "libegl1 libgl1), but here it fails: "
    )
    with pytest.raises(RenderError, match=re.escape(sentence)), off_screen():
        pass


@LINUX
def test_without_egl_a_screen_will_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setitem(sys.modules, "mujoco.egl", None)
    module = sys.modules[mujoco.Renderer.__module__].gl_context
    usual = module.GLContext
    with off_screen():
        assert module.GLContext is usual


@LINUX
def test_the_choice_of_the_user_stands_and_its_failure_is_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "osmesa")
    sentence = "rendering with MUJOCO_GL=osmesa fails: no OSMesa here"
    with pytest.raises(RenderError, match=f"^{re.escape(sentence)}$"), off_screen():
        raise ImportError("no OSMesa\nhere.")


def test_the_camera_of_a_film_does_not_sway() -> None:
    from preview_walk.viewer.video import _smooth

    t = np.linspace(0.0, 10.0, 1001)
    path = np.column_stack([0.3 * t, 0.05 * np.sin(2 * np.pi * t / 0.8), np.full_like(t, 0.8)])
    way = _smooth(path, 100)
    assert way.shape == path.shape
    np.testing.assert_allclose(way[100:-100, 0], path[100:-100, 0], atol=1e-9)
    assert np.abs(way[100:-100, 1]).max() < 0.01
    np.testing.assert_allclose(way[:, 2], 0.8)
