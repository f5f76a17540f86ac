"""The pictures of the README: a stride of TALOS as a strip, the plot of the walk, a moving picture.

python docs/pictures.py
"""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import preview_walk as pw
from preview_walk import frames

HERE = Path(__file__).parent
COUNT, HEIGHT, WIDTH = 7, 420, 200  # pictures in the strip, and their pixels
COLOURS = 128
GIF_SIZE, GIF_FPS = (260, 340), 12
SIDE = (0.0, 375.0, 0.0)  # N, for 0.2 s


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
        # In its own colours: a palette would make one of the CoM's and the DCM's.
        smaller = picture.convert("RGB").resize(
            (1100, round(1100 * picture.height / picture.width))
        )
    smaller.save(overview, optimize=True)
    move(robot)


def move(robot: pw.Robot) -> None:
    """Write walk.gif: walking and turning, stairs, and a push of 75 N·s from the side."""
    planner = pw.FootstepPlanner(0.3, robot.step_width, step_time=0.8)
    stairs = pw.read_ground("stairs:rise=0.17,tread=0.28,count=6")
    treads = pw.FootstepPlanner(0.28, robot.step_width, step_time=1.2)
    scenes = (
        (pw.simulate_commands(robot, [((0.5, 0.0, 0.5), 6.0)]), 2.0, 6.0),
        (pw.simulate(robot, treads.generate_footsteps(9, ramp=1), ground=stairs), 5.0, 9.0),
        (
            pw.simulate(robot, planner.generate_footsteps(10), pushes=[pw.Push(3.3, 0.2, SIDE)]),
            2.6,
            6.6,
        ),
    )
    pictures = []
    for record, begin, end in scenes:
        times = np.arange(begin, end, 1.0 / GIF_FPS).tolist()
        for time, picture in zip(times, frames(record, robot, times, GIF_SIZE), strict=True):
            image = Image.fromarray(picture)
            if any(abs(time - push["t"]) < 0.4 for push in record.run.pushes):
                ImageDraw.Draw(image).text((8, 6), "75 N·s to the left", fill=(200, 30, 30))
            pictures.append(image.quantize(64, dither=Image.Dither.NONE))
    path = HERE / "walk.gif"
    pictures[0].save(
        path,
        save_all=True,
        append_images=pictures[1:],
        duration=round(1000 / GIF_FPS),
        loop=0,
        optimize=True,
    )
    print(f"wrote {path} ({path.stat().st_size / 1024:.0f} KB)")


if __name__ == "__main__":
    main()
