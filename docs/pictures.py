"""The pictures of the README: one stride of TALOS as a strip, and the overview plot of the walk.

python docs/pictures.py
"""

from pathlib import Path

import numpy as np
from PIL import Image

import preview_walk as pw
from preview_walk import frames

HERE = Path(__file__).parent
COUNT, HEIGHT, WIDTH = 7, 420, 200  # pictures in the strip, and their pixels
COLOURS = 128


def small(picture: Image.Image, name: str) -> None:
    """Write a picture with a palette: a quarter of the size, and no difference to see."""
    path = HERE / name
    picture.convert("RGB").quantize(COLOURS).save(path, optimize=True)
    print(f"wrote {path} ({path.stat().st_size / 1024:.0f} KB)")


def main() -> None:
    """Walk at 0.6 m/s, then draw."""
    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(0.45, robot.step_width, step_time=0.7, double_support_ratio=0.1)
    plan = planner.generate_footsteps(14, ramp=4)
    record = pw.simulate(robot, plan)
    print(record.summary())

    # One stride in the middle of the walk: from a landing to the next but one.
    first, last = plan.steps[6].land, plan.steps[8].land
    times = np.linspace(first, last, COUNT, endpoint=False).tolist()
    strip = np.hstack(list(frames(record, robot, times, (HEIGHT, WIDTH))))
    small(Image.fromarray(strip), "walk.png")

    overview = HERE / "overview.png"
    pw.plot(record, overview)
    with Image.open(overview) as picture:
        small(picture.resize((1100, round(1100 * picture.height / picture.width))), "overview.png")


if __name__ == "__main__":
    main()
