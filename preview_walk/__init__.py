"""Humanoid walking by LQR preview control and whole-body quadratic programming."""

from preview_walk.analysis import plot
from preview_walk.planning.footstep_planner import FootstepPlanner
from preview_walk.planning.preview_controller import PreviewController
from preview_walk.planning.swing_trajectory import SwingLegTrajectory
from preview_walk.planning.zmp_trajectory import ZMPTrajectoryGenerator
from preview_walk.robots.load import load_robot
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.record import Record
from preview_walk.simulation.walk import Walk, simulate

__all__ = [
    "FootstepPlanner",
    "PreviewController",
    "Push",
    "Record",
    "SwingLegTrajectory",
    "Walk",
    "ZMPTrajectoryGenerator",
    "load_robot",
    "plot",
    "simulate",
]
