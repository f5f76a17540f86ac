"""A task of one's own: TALOS carries a full cup while it walks.

A task is a class with `rows`, `weight` and `update`. This one keeps a link's orientation in the
world: its angular acceleration, J a + drift, is to be a spring and a damper on what it has turned.
Compare what the cup does without it.

python examples/own_task.py
"""

import argparse

import numpy as np
import pinocchio as pin

import preview_walk as pw
from preview_walk import Array, Dynamics


class CarryLevel:
    """Keep a link's orientation (critically damped, `frequency` in rad/s)."""

    rows = 3  # equations: one per axis of rotation
    weight = 1.0  # against 100 for the CoM and the feet, 2 for the torso

    def __init__(self, dynamics: Dynamics, link: str, frequency: float = 15.0) -> None:
        self.link = dynamics.frame(link)  # kept up to date by the controller
        self.goal = self.link.rotation.copy()
        self.stiffness, self.damping = frequency**2, 2.0 * frequency

    def update(self, dynamics: Dynamics, jacobian: Array, target: Array) -> None:
        """Write `jacobian @ a = target`, in the link's own axes."""
        turned = pin.log3(self.link.rotation.T @ self.goal)
        jacobian[:] = self.link.jacobian[3:]
        target[:] = self.stiffness * turned - self.damping * self.link.velocity[3:]
        target -= self.link.drift[3:]


def tilt_of_the_cup(carried: bool) -> float:
    """Walk and return how far the right hand tilted at most, in degrees."""
    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.5, step_width=robot.step_width, step_time=0.75)
    worst = 0.0

    def watch(walk: pw.Walk) -> None:
        """Note the tilt at the end of a tick."""
        nonlocal worst
        cosine = np.clip((cup.link.rotation @ up)[2], -1.0, 1.0)
        worst = max(worst, np.degrees(np.arccos(cosine)))

    walk = pw.Walk(robot, planner.generate_footsteps(10, ramp=4), on_tick=watch)
    body = walk.walker.body
    cup = CarryLevel(body.dynamics, "arm_right_7_link")
    up = cup.goal.T @ [0.0, 0.0, 1.0]
    if carried:
        body.add_task(cup)
    walk.run()
    return worst


def main() -> None:
    """Walk without and with the task."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(f"without the task, the cup tilts by up to {tilt_of_the_cup(carried=False):.1f} degrees")
    print(f"with the task, by up to {tilt_of_the_cup(carried=True):.1f} degrees")


if __name__ == "__main__":
    main()
