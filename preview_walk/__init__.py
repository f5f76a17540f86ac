"""Humanoid walking by LQR preview control and whole-body quadratic programming.

The public names of all rooms, loaded when they are first used: planning alone needs no simulator,
and a wrong option of the command is told at once.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from preview_walk.analysis import Summary, plot, plot_all, save_plot
    from preview_walk.errors import InvalidInput, PreviewWalkError, RobotError
    from preview_walk.files import OutputError
    from preview_walk.offscreen import RenderError
    from preview_walk.planning.cart_table import ComState, ComTrajectory, cart_table
    from preview_walk.planning.check import check_plan, require_walkable
    from preview_walk.planning.footholds import from_list, to_pose
    from preview_walk.planning.footstep_planner import FootstepPlanner, Stride
    from preview_walk.planning.footsteps import Footstep, FootstepPlan
    from preview_walk.planning.gaits import arc, on_the_spot, sideways, straight, turn_in_place
    from preview_walk.planning.limits import GaitLimits
    from preview_walk.planning.preview_controller import PreviewController
    from preview_walk.planning.preview_gains import PreviewDesign, preview_gains
    from preview_walk.planning.preview_response import preview_effect, track
    from preview_walk.planning.support import Sole
    from preview_walk.planning.swing_trajectory import Swing, SwingLegTrajectory
    from preview_walk.planning.velocity import follow_velocity
    from preview_walk.planning.zmp_trajectory import ZMPTrajectoryGenerator, zmp_reference
    from preview_walk.robots.inspection import inspect_robot
    from preview_walk.robots.listing import list_robots
    from preview_walk.robots.load import load_robot
    from preview_walk.robots.robot import Robot
    from preview_walk.simulation.pushes import Push, random_pushes
    from preview_walk.simulation.record import Record
    from preview_walk.simulation.simulate import simulate, simulate_commands
    from preview_walk.simulation.video import render_video
    from preview_walk.simulation.walk import Walk
    from preview_walk.simulation.walking_controller import WalkingController
    from preview_walk.tracking.gains import TrackingGains

_HOMES = {
    "analysis": ("Summary", "plot", "plot_all", "save_plot"),
    "errors": ("InvalidInput", "PreviewWalkError", "RobotError"),
    "files": ("OutputError",),
    "offscreen": ("RenderError",),
    "planning.cart_table": ("ComState", "ComTrajectory", "cart_table"),
    "planning.check": ("check_plan", "require_walkable"),
    "planning.footholds": ("from_list", "to_pose"),
    "planning.footstep_planner": ("FootstepPlanner", "Stride"),
    "planning.footsteps": ("Footstep", "FootstepPlan"),
    "planning.gaits": ("arc", "on_the_spot", "sideways", "straight", "turn_in_place"),
    "planning.limits": ("GaitLimits",),
    "planning.preview_controller": ("PreviewController",),
    "planning.preview_gains": ("PreviewDesign", "preview_gains"),
    "planning.preview_response": ("preview_effect", "track"),
    "planning.support": ("Sole",),
    "planning.swing_trajectory": ("Swing", "SwingLegTrajectory"),
    "planning.velocity": ("follow_velocity",),
    "planning.zmp_trajectory": ("ZMPTrajectoryGenerator", "zmp_reference"),
    "robots.inspection": ("inspect_robot",),
    "robots.listing": ("list_robots",),
    "robots.load": ("load_robot",),
    "robots.robot": ("Robot",),
    "simulation.pushes": ("Push", "random_pushes"),
    "simulation.record": ("Record",),
    "simulation.simulate": ("simulate", "simulate_commands"),
    "simulation.video": ("render_video",),
    "simulation.walk": ("Walk",),
    "simulation.walking_controller": ("WalkingController",),
    "tracking.gains": ("TrackingGains",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "ComState",
    "ComTrajectory",
    "Footstep",
    "FootstepPlan",
    "FootstepPlanner",
    "GaitLimits",
    "InvalidInput",
    "OutputError",
    "PreviewController",
    "PreviewDesign",
    "PreviewWalkError",
    "Push",
    "Record",
    "RenderError",
    "Robot",
    "RobotError",
    "Sole",
    "Stride",
    "Summary",
    "Swing",
    "SwingLegTrajectory",
    "TrackingGains",
    "Walk",
    "WalkingController",
    "ZMPTrajectoryGenerator",
    "arc",
    "cart_table",
    "check_plan",
    "follow_velocity",
    "from_list",
    "inspect_robot",
    "list_robots",
    "load_robot",
    "on_the_spot",
    "plot",
    "plot_all",
    "preview_effect",
    "preview_gains",
    "random_pushes",
    "render_video",
    "require_walkable",
    "save_plot",
    "sideways",
    "simulate",
    "simulate_commands",
    "straight",
    "to_pose",
    "track",
    "turn_in_place",
    "zmp_reference",
]


def __getattr__(name: str) -> Any:
    """Load a public name when it is first asked for (PEP 562)."""
    home = _HOME_OF.get(name)
    if home is None:
        raise AttributeError(f"module 'preview_walk' has no attribute '{name}'")
    value = getattr(import_module(f"preview_walk.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the public names beside what is loaded."""
    return sorted({*globals(), *__all__})
