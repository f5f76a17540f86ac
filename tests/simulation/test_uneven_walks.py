"""Walks over edges, by command, pushed, and over ground that nobody sees."""

from __future__ import annotations

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.robots.robot import Robot
from preview_walk.simulation.fall import over_edges
from preview_walk.terrain.ground import Ground
from preview_walk.terrain.shapes import blocks, slope, stairs
from preview_walk.types import Array


def errors(record: pw.Record) -> Array:
    """Return the CoM's rms errors (3,), mm."""
    rms: Array = 1e3 * np.sqrt(((record.com - record.com_ref) ** 2).mean(axis=0))
    return rms


def assert_soles_lie(record: pw.Record, ground: Ground) -> None:
    """Every sole that bears half the weight lies on the ground, to what contacts give way."""
    for foot in ("left", "right"):
        pose, force = getattr(record, f"{foot}_foot"), getattr(record, f"{foot}_force")
        x, y, z = pose[force[:, 2] > 0.5 * record.run.weight, :3, 3].T
        assert np.abs(z - ground.height(x, y)).max() < 5e-3


@pytest.mark.parametrize("rise", [0.15, -0.15])
def test_stairs_are_walked_without_touching_their_edges(talos: Robot, rise: float) -> None:
    ground = stairs(rise, 0.28, 3)
    planner = pw.FootstepPlanner(0.28, talos.step_width, 1.2)
    record = pw.simulate(talos, planner.generate_footsteps(6, ramp=1), ground=ground)
    assert not record.run.fell
    # Measured: 0.1 mm and less; a swing over the straight line falls or is off by 8 mm.
    assert errors(record).max() < 0.5
    assert_soles_lie(record, ground)
    plan = record.plans[-1]
    for foot, lift, land in zip(plan.foot[2:], plan.lifts, plan.landings, strict=True):
        share = (record.time - lift) / (land - lift)
        force = record.left_force if foot == 0 else record.right_force
        assert np.abs(force[(share > 0.1) & (share < 0.9)]).max() < 1.0


def test_commands_are_laid_on_the_ground_as_they_come(talos: Robot) -> None:
    ground = stairs(0.08, 0.35, 3)
    record = pw.simulate_commands(talos, [((0.25, 0.0, 0.0), 6.0)], ground=ground)
    assert not record.run.fell
    assert record.com[-1, 2] - record.com[0, 2] > 0.15
    assert errors(record).max() < 1.0  # measured: 0.1 mm
    assert_soles_lie(record, ground)


def test_a_step_after_a_push_lands_on_the_ground(talos: Robot) -> None:
    ground = slope(6.0, begin=0.12)
    plan = pw.FootstepPlanner(0.2, talos.step_width, 0.9).generate_footsteps(5, ramp=1)
    push = pw.Push(4.1, 0.1, (0.0, 400.0, 0.0))
    record = pw.simulate(talos, plan, ground=ground, pushes=[push])
    assert not record.run.fell
    assert len(record.plans) > 1  # it answered by other steps
    last = record.plans[-1]
    for pose in last.pose[-3:]:  # beyond the crease, where soles may lie across it
        assert pose[2, 3] == pytest.approx(float(ground.height(pose[0, 3], pose[1, 3])), abs=1e-6)
        assert pose[:3, 2] == pytest.approx(ground.normal(pose[0, 3], pose[1, 3]), abs=1e-6)


@pytest.mark.parametrize("ground", [slope(-8.0), blocks(0.02, 0.3, seed=2)])
def test_unseen_ground_is_felt(talos: Robot, ground: Ground) -> None:
    record = pw.simulate_commands(talos, [((0.3, 0.0, 0.0), 5.0)], ground=ground, blind=True)
    assert not record.run.fell
    assert record.run.blind
    assert errors(record).max() < 8.0  # measured: 1 mm on slopes, 2 to 4 mm on blocks
    # The plan has gone with the ground: its last soles are where the feet are.
    last = record.plans[-1]
    for foot, sole in (("left", record.left_foot[-1]), ("right", record.right_foot[-1])):
        assert last.last_pose(foot)[2, 3] == pytest.approx(sole[2, 3], abs=0.02)


def test_an_unseen_step_down_is_searched_for(talos: Robot) -> None:
    ground = stairs(-0.06, 2.0, 1, begin=0.6)
    record = pw.simulate_commands(talos, [((0.3, 0.0, 0.0), 4.0)], ground=ground, blind=True)
    assert not record.run.fell
    assert record.com[-1, 2] - record.com[0, 2] == pytest.approx(-0.06, abs=0.02)


def test_a_fall_over_an_edge_says_so() -> None:
    sole, ground = pw.Sole(0.1, 0.05), stairs(0.1, 0.3, 2, begin=0.5)
    on = {"left": pw.pose_at(0.0, 0.1), "right": pw.pose_at(0.0, -0.1)}
    assert over_edges(on, sole, ground) == ""
    across = {"left": pw.pose_at(0.45, 0.1), "right": pw.pose_at(0.0, -0.1)}
    assert over_edges(across, sole, ground) == "; over an edge of the ground: left sole"
    both = over_edges(on, sole, slope(20.0, begin=0.01))
    assert both == "; over an edge of the ground: left and right sole"
