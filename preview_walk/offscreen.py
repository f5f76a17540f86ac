"""Pictures without a screen, whatever was imported before and whether MUJOCO_GL is set or not.

MuJoCo chooses how it gets at OpenGL when it is first imported, and without the environment variable
MUJOCO_GL it chooses a window, which needs a screen. Here the choice is made when it is needed.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import mujoco

from preview_walk.errors import PreviewWalkError


class RenderError(PreviewWalkError, RuntimeError):
    """A picture or film could not be made; says why."""


@contextmanager
def off_screen() -> Iterator[None]:
    """Let every `mujoco.Renderer` made in this block draw without a screen.

    On Linux that is EGL, unless MUJOCO_GL names something else; where EGL is missing and there is a
    screen, a hidden window on it. Other systems need nothing.

    Raises:
        RenderError: there is neither EGL nor a screen, or what MUJOCO_GL names does not work.
    """
    choice = os.environ.get("MUJOCO_GL", "").lower().strip()
    if not sys.platform.startswith("linux") or choice not in ("", "egl"):
        try:
            yield
        except (mujoco.FatalError, AttributeError, ImportError) as error:
            raise RenderError(f"rendering with MUJOCO_GL={choice} fails: {_line(error)}") from error
        return
    try:
        from mujoco.egl import GLContext

        GLContext(1, 1).free()
    except Exception as error:  # whatever the drivers raise
        if choice == "" and os.environ.get("DISPLAY"):
            yield
            return
        raise RenderError(
            "rendering without a screen needs OpenGL's EGL (on Debian or Ubuntu: sudo apt install "
            f"libegl1 libgl1), but here it fails: {_line(error)}"
        ) from error
    # The module in which the renderer looks its context up, wherever this version keeps it.
    module = sys.modules[mujoco.Renderer.__module__].gl_context
    usual = module.GLContext
    module.GLContext = GLContext
    try:
        yield
    finally:
        module.GLContext = usual


def _line(error: Exception) -> str:
    return " ".join(str(error).split()).rstrip(".")
