"""`--inspect`: the report on a model, and its stance as a picture."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from preview_walk.cli.naming import naming
from preview_walk.cli.streams import complain, say
from preview_walk.controller.robot_limits import gait_limits, usual_planner
from preview_walk.files import make_folder, whole_file
from preview_walk.pattern.check import check_plan
from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.robot import Robot

PICTURE = "stance.png"

_STEPS, _RAMP = 8, 2
"""The walk that is looked at: it comes to its full steps and stops."""


def inspect_model(model: str, folder: Path) -> bool:
    """Print the report on a model (name or path) and draw its stance; tell whether it can stand.

    Raises:
        PreviewWalkError: the picture cannot be drawn or written.
    """
    inspection = inspect_robot(model)
    if inspection.robot is not None:
        problems = (*inspection.problems, *walk_problems(inspection.robot))
        inspection = replace(inspection, problems=problems)
    say(str(inspection))
    if inspection.robot is None:
        complain(f"--inspect: {inspection.problems[0].rstrip('.')}.")
        return False
    make_folder(folder, [PICTURE])
    picture = folder / PICTURE
    with naming("--inspect"), whole_file(picture) as part:
        inspection.write_picture(part)
    say(f"\nstance and soles: {picture}")
    return True


def walk_problems(robot: Robot) -> tuple[str, ...]:
    """Return why the walk that `--robot` alone asks for is refused, in words; () if it is not."""
    planner = usual_planner(robot)
    found = check_plan(planner.generate_footsteps(_STEPS, ramp=_RAMP), gait_limits(robot))
    walk = f"steps of {planner.step_length:.3f} m in {planner.step_time:.2f} s"
    return tuple(f"{walk}: {finding.text}" for finding in found[:1])
