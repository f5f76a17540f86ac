"""`--inspect`: the report on a model, and its stance as a picture."""

from __future__ import annotations

from pathlib import Path

from preview_walk.cli.naming import naming
from preview_walk.cli.streams import complain, say
from preview_walk.files import make_folder, whole_file
from preview_walk.robots.inspection import inspect_robot

PICTURE = "stance.png"


def inspect_model(model: str, folder: Path) -> bool:
    """Print the report on a model (name or path) and draw its stance; tell whether it can stand.

    Raises:
        PreviewWalkError: the picture cannot be drawn or written.
    """
    inspection = inspect_robot(model)
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
