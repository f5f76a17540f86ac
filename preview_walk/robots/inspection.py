"""`inspect_robot`: what was found in a model, what was assumed, and what will not work."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from preview_walk.arguments import shown
from preview_walk.errors import RobotError
from preview_walk.files import as_path
from preview_walk.robots.building.rebuild import rebuild
from preview_walk.robots.load import load_robot
from preview_walk.robots.picture import write_picture
from preview_walk.robots.problems import problems_of
from preview_walk.robots.reading.description import describe
from preview_walk.robots.reading.facts import Description
from preview_walk.robots.reading.mjcf import compile_spec
from preview_walk.robots.reading.shapes import add_shapes
from preview_walk.robots.reading.source import read_source
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET


@dataclass(frozen=True, eq=False)
class Inspection:
    """What is known about a model, in sentences.

    Attributes:
        source: where the model came from.
        found: what is read from the model.
        assumed: what was adapted or guessed.
        missing: what would be nice to have.
        problems: what will not work.
        robot: the robot; None if it cannot walk.
    """

    source: str
    found: tuple[str, ...]
    assumed: tuple[str, ...]
    missing: tuple[str, ...]
    problems: tuple[str, ...]
    robot: Robot | None

    def __str__(self) -> str:
        """Return the report."""
        parts = [self.source]
        for title, lines in (
            ("found", self.found),
            ("assumed or adapted", self.assumed),
            ("missing", self.missing),
            ("will not work", self.problems),
        ):
            parts.append(f"\n{title}:")
            parts += [f"  - {line}" for line in lines] or ["  nothing"]
        return "\n".join(parts)

    def __repr__(self) -> str:
        """Say it in one line."""
        return f"<Inspection of '{self.source}': {len(self.problems)} problem(s)>"

    def write_picture(self, path: str | Path) -> None:
        """Write a picture of the stance with the soles in red (left) and green (right).

        Args:
            path: the .png file to write.

        Raises:
            RobotError: the model cannot stand.
            InvalidInput: the path is none, or does not end in .png.
            OutputError: the file cannot be written.
        """
        if self.robot is None:
            raise RobotError(f"no picture of '{self.source}': {self.problems[0]}", "model")
        write_picture(self.robot, as_path(path))


def inspect_robot(model: str | Path | mujoco.MjModel | mujoco.MjSpec) -> Inspection:
    """Return what is found, assumed, missing and wrong in a robot's model; never raises for it.

    Args:
        model: what `load_robot` takes.
    """
    in_hand = isinstance(model, (mujoco.MjModel, mujoco.MjSpec))
    source = "the model in hand" if in_hand else shown(model).strip("'")
    try:
        robot = load_robot(model)
    except RobotError as error:
        found = _contents(model) if in_hand or isinstance(model, (str, Path)) else ()
        return Inspection(source, found, (), (), (str(error),), None)
    return Inspection(
        source, _found(robot), robot.notes, _missing(robot), problems_of(robot), robot
    )


def _contents(model: str | Path | mujoco.MjModel | mujoco.MjSpec) -> tuple[str, ...]:
    """Return what can be said about a model that is no robot."""
    try:
        given: Description | mujoco.MjModel
        if isinstance(model, mujoco.MjSpec):
            given = compile_spec(model.copy(), "the spec")[0]
        else:
            given = model if isinstance(model, mujoco.MjModel) else describe(model)
        tree = read_source(given).tree
    except RobotError:
        return ()
    tips = ", ".join(tree.name(tip) for tip in tree.tips)
    joints = len(tree.joints_on(list(range(1, tree.mj.nbody))))
    return (
        f"{tree.mj.nbody - 1} bodies, {joints} joints, {tree.mj.nu} actuators, "
        f"{tree.mj.body_mass.sum():.1f} kg",
        f"limbs end at: {tips or 'none'}",
    )


def _found(robot: Robot) -> tuple[str, ...]:
    """Return what the model says about itself."""
    tree, parts, model = robot.blueprint.tree, robot.blueprint.parts, robot.pin
    lines = [
        f"{robot.mass:.1f} kg, {len(robot.joint_names)} joints, {robot.mj.nu} motors",
        f"base '{tree.name(parts.base)}', trunk '{tree.name(parts.torso)}'",
    ]
    for foot in FEET:
        leg, sole = robot.legs[foot], robot.soles[foot]
        lines.append(
            f"{foot} leg: {', '.join(model.names[j] for j in leg.joints)}; knee "
            f"'{model.names[leg.knee]}'"
        )
        lines.append(
            f"{foot} sole on '{robot.blueprint.soles[foot].body}': "
            f"{2 * sole.half_length:.3f} x {2 * sole.half_width:.3f} m"
        )
    lines.append(
        f"leg length {robot.leg_length:.3f} m; in the walking posture the CoM is "
        f"{robot.com_height:.3f} m high and the soles are {robot.step_width:.3f} m apart"
    )
    friction = robot.mj.dof_frictionloss[6:]
    if friction.any():
        worst = robot.joint_names[int(friction.argmax())]
        lines.append(
            f"dry friction in {np.count_nonzero(friction)} joint(s), up to {friction.max():.2g} "
            f"N·m in '{worst}'; the walk does not make up for it"
        )
    return tuple(lines)


def _missing(robot: Robot) -> tuple[str, ...]:
    """Return what a better model would hold."""
    lines = []
    for what, lacking in (
        ("motors (these joints hang loose)", robot.effort == 0.0),
        ("position limits", np.isinf(robot.q_lower) & np.isinf(robot.q_upper)),
        ("speed limits", np.isinf(robot.v_limit)),
    ):
        names = [name for name, lacks in zip(robot.joint_names, lacking, strict=True) if lacks]
        if len(names) == len(robot.joint_names):
            lines.append(f"{what}: none of the joints has any")
        elif names:
            lines.append(f"{what}: {', '.join(names)}")
    plan = robot.blueprint
    if plan.urdf is not None:
        spec, _ = rebuild(plan.tree, plan.parts.base, plan.locked, looks=False)
        lost = sorted(set(add_shapes(plan.urdf, spec, "visual")))
        if lost:
            lines.append(f"visual meshes that are not found or not readable: {', '.join(lost)}")
    return tuple(lines)
