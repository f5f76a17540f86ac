"""A film of TALOS walking, rendered without a screen, and a strip of its pictures.

python examples/video.py --out video.mp4
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw
from preview_walk import FPS, frames

COUNT = 6


def main() -> None:
    """Walk, write the film, and one stride as a strip of pictures beside it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="video.mp4", help="the film to write")
    out = Path(parser.parse_args().out)

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.4, step_width=robot.step_width, step_time=0.7)
    plan = planner.generate_footsteps(7, ramp=2)
    record = pw.simulate(robot, plan)
    print(record.summary())
    pw.render_video(record, robot, out)

    # One stride in the middle of the walk: from a landing to the next but one.
    first, last = plan.steps[2].land, plan.steps[4].land
    times = np.linspace(first, last, COUNT, endpoint=False).tolist()
    figure = Figure(figsize=(2.6 * COUNT, 4.6), layout="constrained")
    pictures = frames(record, robot, times, size=(720, 440))
    for axes, time, picture in zip(figure.subplots(1, COUNT), times, pictures, strict=True):
        axes.imshow(picture)
        axes.set_title(f"{time:.2f} s")
        axes.axis("off")
    strip = out.with_suffix(".png")
    figure.savefig(strip, dpi=100)
    print(f"wrote {out} ({record.time[-1]:.1f} s at {FPS} frames a second) and {strip}")


if __name__ == "__main__":
    main()
