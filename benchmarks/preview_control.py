"""How fast is preview control here, against a naive double loop and against Drake if installed.

All ratios come from one run on one machine: 10 s of walking at 5 ms, both axes, Kajita's
parameters; then walks up to one hour long; then one tick of the online controller.

    python benchmarks/preview_control.py
"""

from __future__ import annotations

import importlib
import importlib.util
import time
from collections.abc import Callable
from functools import partial

import numpy as np

from preview_walk import Array, ComState, PreviewController

DT = 0.005
STEP_TIME, RAMP, STAND = 0.5, 0.1, 2.0
STEP = np.array([0.15, 0.0])
HALF_WIDTH = np.array([0.0, 0.05])


def footholds(duration: float) -> tuple[Array, Array]:
    """Return the (K,) times and (K, 2) ZMP points between which the reference is linear."""
    times, points, foot = [0.0], [np.zeros(2)], np.zeros(2)
    for i, lift in enumerate(np.arange(STAND, duration - STAND, STEP_TIME)):
        foot = foot + STEP
        times += [float(lift), float(lift) + RAMP]
        points += [points[-1], foot + HALF_WIDTH * (-1) ** i]
    return np.array(times), np.array(points)


def walk(duration: float) -> Array:
    """Return the ZMP reference, (N, 2), sampled at DT."""
    times, points = footholds(duration)
    t = np.arange(round(duration / DT) + 1) * DT
    return np.stack([np.interp(t, times, points[:, axis]) for axis in (0, 1)], axis=1)


def double_loop(controller: PreviewController, reference: Array) -> Array:
    """Return com (N, 2): the law of Kajita 2003 as it is usually typed, sample by sample."""
    design = controller.design
    a, b = design.system.A.tolist(), design.system.B[:, 0].tolist()
    lever = controller.z_c / 9.81
    integral = design.integral_gain.item()
    state_gain = design.state_gain[0].tolist()
    preview = design.preview_gain[:, 0, 0].tolist()
    com = np.empty_like(reference)
    for axis in (0, 1):
        samples = reference[:, axis].tolist()
        samples += [samples[-1]] * len(preview)
        x, total = [samples[0], 0.0, 0.0], 0.0
        for k in range(len(reference)):
            com[k, axis] = x[0]
            total += x[0] - lever * x[2] - samples[k]
            jerk = -integral * total - sum(g * v for g, v in zip(state_gain, x, strict=True))
            for ahead, gain in enumerate(preview):
                jerk -= gain * samples[k + 1 + ahead]
            x = [
                sum(g * v for g, v in zip(row, x, strict=True)) + entry * jerk
                for row, entry in zip(a, b, strict=True)
            ]
    return com


def online(controller: PreviewController, reference: Array) -> ComState:
    """Return the last state of the online controller run over a whole reference."""
    n = controller.n_preview
    held = np.concatenate([reference, np.repeat(reference[-1:], n, axis=0)])
    state = controller.initial_state(reference[0])
    for k in range(1, len(reference)):
        state = controller.step(state, held[k : k + n])
    return state


def drake(reference_time: float) -> Callable[[], Array] | None:
    """Return a call that plans and samples the same walk with Drake's ZmpPlanner, or None."""
    if importlib.util.find_spec("pydrake") is None:
        return None
    planning = importlib.import_module("pydrake.planning")
    trajectories = importlib.import_module("pydrake.trajectories")
    times, points = footholds(reference_time)
    times, points = np.append(times, reference_time), np.vstack([points, points[-1:]])
    samples = np.arange(round(reference_time / DT) + 1) * DT

    def plan() -> Array:
        planner = planning.ZmpPlanner()
        path = trajectories.PiecewisePolynomial.FirstOrderHold(times, points.T)
        planner.Plan(path, np.zeros(4), 0.814, 9.81, np.eye(2), 1e-9 * np.eye(2))
        return np.array([planner.get_nominal_com(t) for t in samples])

    return plan


def compare_with_drake(com: Array, reference: Array) -> None:
    """Print how far Drake's CoM is from ours, and how much of that our horizon makes.

    Drake knows the whole walk; `trajectory` sees N samples. Its share is what our own CoM moves
    when it sees 6.4 s instead; what is left is Drake's other cost and its continuous time.
    """
    whole = PreviewController(0.814, DT, 6.4).trajectory(reference).com
    print("  largest and rms CoM difference to Drake; of which the horizon's")
    for seconds in (1.6, 3.2, 4.0, 6.4):
        ours = PreviewController(0.814, DT, seconds).trajectory(reference).com
        gaps = [f"{np.abs(g).max():.1e}, {np.sqrt(np.mean(g**2)):.1e} m" for g in
                (ours - com, ours - whole)]  # fmt: skip
        print(f"    {seconds} s of preview: {gaps[0]}; {gaps[1]}")


def best(call: Callable[[], object], repeats: int) -> float:
    """Return the shortest of several durations of a call (s)."""
    durations = []
    for _ in range(repeats):
        begin = time.perf_counter()
        call()
        durations.append(time.perf_counter() - begin)
    return min(durations)


def main() -> None:
    """Print the table."""
    controller = PreviewController(0.814, DT, 1.6)
    reference = walk(10.0)
    ours = best(lambda: controller.trajectory(reference), 50)
    rows = [
        ("naive double loop", best(lambda: double_loop(controller, reference), 3)),
        ("`step`, tick by tick", best(lambda: online(controller, reference), 5)),
        ("`trajectory`", ours),
    ]
    planner = drake(10.0)
    if planner is not None:
        rows.insert(1, ("Drake ZmpPlanner", best(planner, 10)))
    print("10 s at 5 ms, both axes, N = 320")
    print(f"  {'':<22}{'ms':>10}{'times `trajectory`':>22}")
    for name, seconds in rows:
        print(f"  {name:<22}{1e3 * seconds:>10.3f}{seconds / ours:>22.1f}")
    gap = np.abs(double_loop(controller, reference) - controller.trajectory(reference).com).max()
    print(f"  largest CoM difference to the double loop: {gap:.1e} m")
    if planner is not None:
        compare_with_drake(planner(), reference)
    else:
        print("  Drake is not installed")

    print("whole walks: time per sample of both axes")
    for duration in (10.0, 60.0, 600.0, 3600.0):
        long = walk(duration)
        seconds = best(partial(controller.trajectory, long), 3)
        print(
            f"  {duration:>6.0f} s {1e3 * seconds:>10.2f} ms {1e9 * seconds / len(long):>8.0f} ns"
        )

    state = controller.initial_state((0.0, 0.0))
    window = np.ascontiguousarray(reference[400 : 400 + controller.n_preview])
    following = controller.step(state, window)
    count = 20000

    def ticks(call: Callable[[], object]) -> float:
        def run() -> None:
            for _ in range(count):
                call()

        return 1e6 * best(run, 5) / count

    print("online, both axes")
    print(f"  step         {ticks(lambda: controller.step(state, window)):.2f} us")
    between = ticks(lambda: controller.interpolate(state, following, 0.002))
    print(f"  interpolate  {between:.2f} us")


if __name__ == "__main__":
    main()
