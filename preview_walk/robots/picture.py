"""A picture of a robot in its walking posture, its soles drawn in colour."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.files import short, whole_file
from preview_walk.offscreen import off_screen
from preview_walk.robots.load import visual_model
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco
from preview_walk.types import FEET

SOLE_COLOURS = {"left": (0.9, 0.25, 0.2, 0.9), "right": (0.2, 0.65, 0.3, 0.9)}
"""Colours of the left and right sole: port and starboard."""


SEEN_THROUGH = 0.4
"""Opacity of the feet, so that the soles in them show."""


def stance_image(
    robot: Robot, width: int = 480, height: int = 640, azimuth: float = 145.0
) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Return a picture (height, width, 3) of the walking posture from the robot's front left.

    Args:
        robot: the robot.
        width: of the picture, pixels.
        height: of the picture, pixels.
        azimuth: heading of the camera in degrees, 180 looking the robot in the face.
    """
    model = visual_model(robot)
    model.vis.global_.offwidth = max(width, model.vis.global_.offwidth)
    model.vis.global_.offheight = max(height, model.vis.global_.offheight)
    model.vis.headlight.ambient[:] = 0.35
    data = mujoco.MjData(model)
    to_mujoco(robot.posture, np.zeros(robot.pin.nv), data.qpos, data.qvel)
    mujoco.mj_forward(model, data)
    option = mujoco.MjvOption()
    option.geomgroup[3] = 1
    for foot in FEET:
        sole = model.geom(f"{foot}_sole")
        foot_body = model.body_weldid[sole.bodyid[0]]
        model.geom_rgba[model.body_weldid[model.geom_bodyid] == foot_body, 3] = SEEN_THROUGH
        sole.rgba = SOLE_COLOURS[foot]
    shown = model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE
    top = float((data.geom_xpos[:, 2] + 0.7 * model.geom_rbound)[shown].max())
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (0.0, 0.0, 0.54 * top)
    camera.distance, camera.azimuth, camera.elevation = 1.75 * top + 0.3, azimuth, -12.0
    with off_screen():
        renderer = mujoco.Renderer(model, height, width)
    with renderer:
        renderer.update_scene(data, camera, option)
        return np.array(renderer.render())


def write_picture(robot: Robot, path: Path) -> None:
    """Write the picture of the walking posture: front left beside the left side.

    Args:
        robot: the robot.
        path: the .png file to write.

    Raises:
        InvalidInput: the name does not end in .png.
        OutputError: the file cannot be written.
    """
    from matplotlib.image import imsave

    if path.suffix.lower() != ".png":
        raise InvalidInput(f"a picture's file name must end in .png, got '{short(path)}'.", "path")
    views = [stance_image(robot, azimuth=azimuth) for azimuth in (145.0, 270.0)]
    with whole_file(path) as part:
        imsave(part, np.hstack(views))
