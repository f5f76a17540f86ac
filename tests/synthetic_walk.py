"""A record in closed form, for tests that need a walk but no robot: every figure is known.

The CoM moves at a constant speed and sways; measured values are the references plus constant
offsets, so errors are what they were made to be.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.record.record import Record
from preview_walk.record.recorder import Recorder
from preview_walk.record.run_facts import RunFacts

DT = 0.005
COM_ERROR = np.array([0.002, -0.001, 0.003])
ZMP_ERROR = np.array([0.004, 0.007])
FOOT_ERROR = np.array([0.003, 0.004, 0.0])
COM_HEIGHT = 0.85
MASS, GRAVITY = 90.0, 9.81
TAU_MAX = [100.0, 50.0, 0.0]

FACTS = {
    "robot": "synthetic",
    "mass": MASS,
    "gravity": GRAVITY,
    "joint_names": ["hip", "knee", "free"],
    "tau_max": TAU_MAX,
    "omega": float(np.sqrt(GRAVITY / COM_HEIGHT)),
    "control_hz": 1 / DT,
    "physics_hz": 1000.0,
    "com_height": COM_HEIGHT,
    "leg_length": 0.9,
    "step_width": 0.17,
    "sole": [0.105, 0.065],
    "seed": 0,
    "pushes": [],
    "fell": False,
    "fall_time": None,
    "fall_reason": None,
    "interrupted": False,
    "wall_time": 2.0,
}

SAME: dict[str, Any] = {
    "com_acceleration_ref": np.zeros(3),
    "push": np.zeros(3),
    "torso_tilt": 0.01,
    "tick_time": 3e-4,
    "terms_time": 5e-5,
    "assembly_time": 8e-5,
    "qp_time": 1.5e-4,
    "qp_iterations": 20,
    "qp_status": 0,
    "qp_solver": 0,
}
"""What is the same in every row."""


def walk_plan(n_steps: int = 8, start: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Any:
    """Return a walk of `n_steps` steps of 0.25 m in 0.9 s."""
    planner = FootstepPlanner(0.25, 0.17, 0.9, 0.2)
    return planner.generate_footsteps(n_steps, start)


def walk_record(
    n_steps: int = 8,
    start: tuple[float, float, float] = (0.0, 0.0, 0.0),
    plan: FootstepPlan | None = None,
    **settings: Any,
) -> Record:
    """Return a record of the walk, 200 ticks a second, ending 0.5 s after the plan."""
    plan = plan or walk_plan(n_steps, start)
    run = RunFacts.from_dict({**FACTS, **settings})
    recorder = Recorder(run, {"nq": 10, "nv": 9, "nu": 3}, room=64)
    recorder.plan(0.0, plan)
    for i in range(round((plan.end + 0.5) / DT)):
        recorder.write(**_row(plan, start, n_steps, i * DT))
    return recorder.finish()


def _row(
    plan: FootstepPlan, start: tuple[float, float, float], n_steps: int, t: float
) -> dict[str, Any]:
    """Return the record's fields at time t (s)."""
    omega = np.sqrt(GRAVITY / COM_HEIGHT)
    c, s = np.cos(start[2]), np.sin(start[2])
    axes = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    origin = np.array([start[0], start[1], 0.0])
    width = 0.5 * 0.17
    first, last = plan.steps[0].lift, plan.steps[-1].land
    progress = np.clip((t - first) / (last - first), 0, 1) * (n_steps - 1) * 0.25
    sway, rate = 0.03 * np.sin(np.pi * t / 0.9), 0.03 * np.pi / 0.9 * np.cos(np.pi * t / 0.9)
    com_ref = origin + axes @ [progress, sway, COM_HEIGHT]
    speed = (n_steps - 1) * 0.25 / (last - first)
    velocity = axes @ [speed if first < t < last else 0.0, rate, 0.0]
    phase = plan.support(t)
    side = {0: 0.0, 1: 1.0, 2: -1.0}[phase]
    zmp_ref = (origin + axes @ [progress, side * 0.8 * width, 0])[:2]
    feet = {foot: _foot(plan, foot, t) for foot in ("left", "right")}
    moved = {foot: pose.copy() for foot, pose in feet.items()}
    for pose in moved.values():
        pose[:3, 3] += axes @ FOOT_ERROR
    weight = MASS * GRAVITY
    share = {0: 0.5, 1: 1.0, 2: 0.0}[phase]
    return dict(
        time=t,
        q=np.array([*com_ref, 0, 0, 0, 1, 0.3 * np.sin(t), 0.6 + 0.2 * np.cos(t), 0.0]),
        v=np.array([*velocity, 0, 0, 0, 0.5, -1.0, 0.0]),
        tau=np.array([40.0 * np.sin(3 * t), -45.0 * np.cos(3 * t) ** 2, 0.0]),
        com=com_ref + axes @ COM_ERROR,
        com_ref=com_ref,
        com_velocity=velocity,
        com_velocity_ref=velocity,
        dcm=(com_ref + axes @ COM_ERROR + velocity / omega)[:2],
        dcm_ref=(com_ref + velocity / omega)[:2],
        zmp=zmp_ref + axes[:2, :2] @ ZMP_ERROR,
        zmp_ref=zmp_ref,
        zmp_preview=zmp_ref,
        left_foot=moved["left"],
        right_foot=moved["right"],
        left_foot_ref=feet["left"],
        right_foot_ref=feet["right"],
        left_force=np.array([5.0, 3.0, share * weight, 0, 0, 0]),
        right_force=np.array([-5.0, -3.0, (1 - share) * weight, 0, 0, 0]),
        left_force_ref=np.array([0, 0, share * weight, 0, 0, 0]),
        right_force_ref=np.array([0, 0, (1 - share) * weight, 0, 0, 0]),
        phase=plan.support(t - 0.015),
        phase_ref=phase,
        **SAME,
    )


def _foot(plan: Any, foot: str, t: float) -> Any:
    """Return the sole pose (4, 4): a half sine high while it swings, linear along the ground."""
    pose = plan.sole(foot, t).copy()
    step = plan.swing_at(t)
    if step is not None and step.foot == foot:
        share = (t - step.lift) / (step.land - step.lift)
        pose[:3, 3] += share * (step.pose[:3, 3] - pose[:3, 3])
        pose[2, 3] += 0.05 * np.sin(np.pi * share)
    return pose
