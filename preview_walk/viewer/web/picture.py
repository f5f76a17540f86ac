"""A page's scene: bodies, marks and plots of one moment, and the view that walks along."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from preview_walk.types import Array
from preview_walk.viewer.web.nodes import BodyNodes
from preview_walk.viewer.web.plots import Marks
from preview_walk.viewer.web.stage import Stage

if TYPE_CHECKING:
    from viser import ViserServer

PICTURES = 30
"""Pictures a second."""

LAG = 0.3
"""Time constant (s) with which the view follows: it does not sway with the robot."""

JUMP = 1.0
"""A robot that is further off (m), as after a leap in time, is followed at once."""

VIEW = (1.3, -3.4, 1.6)
"""The camera at first, from between the feet, in heights of the CoM."""


class Picture:
    """All that is seen in a page's scene.

    Attributes:
        follow: whether the view walks along.
    """

    def __init__(self, server: ViserServer, stage: Stage, com_height: float) -> None:
        """Add a stage to an empty page and look at it.

        Args:
            server: of the page.
            stage: what is seen.
            com_height: of the robot, m.
        """
        self.follow = True
        self._server, self._stage = server, stage
        self._nodes = BodyNodes(server.scene, stage.model)
        self._marks = Marks(server.scene)
        self._begun = False
        self._middle, self._height = np.zeros(3), 0.0
        server.initial_camera.position = com_height * np.array(VIEW)
        server.initial_camera.look_at = np.array((0.0, 0.0, 0.9 * com_height))
        server.initial_camera.fov = 0.7

    def show(self, qpos: Array, row: Array | None) -> None:
        """Show a configuration (nq,) of MuJoCo's and a row of the traces, if there is one."""
        self._stage.set(qpos)
        with self._server.atomic():
            self._nodes.update(self._stage.data)
            if row is not None:
                self._marks.show(row)
            if self.follow:
                self._walk_along(self._stage.data.xpos[self._stage.base])

    def _walk_along(self, robot: Array) -> None:
        away = robot - self._middle
        near = float(np.abs(away).max()) < JUMP
        self._middle += away * (1.0 / (LAG * PICTURES) if near and self._begun else 1.0)
        if not self._begun:
            self._begun, self._height = True, float(robot[2])
        self._nodes.root.position = (0.0, 0.0, self._height) - self._middle
