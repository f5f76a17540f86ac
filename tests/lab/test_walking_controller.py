"""The walking lab's controller, in models and data that somebody else made."""

from __future__ import annotations

import re
import warnings

import mujoco
import numpy as np
import pytest
from lab_walks import XML, History, assert_followed, walk

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.lab.walking_controller import WalkingController


@pytest.fixture
def spec() -> mujoco.MjSpec:
    return mujoco.MjSpec.from_file(str(XML))


@pytest.fixture(scope="module")
def lab() -> tuple[WalkingController, History]:
    """Return the lab's walk: six steps."""
    model = mujoco.MjModel.from_xml_path(str(XML))
    controller = WalkingController(model, mujoco.MjData(model))
    return controller, controller.run_walking(n_steps=6)


def test_the_lab_walks(lab: tuple[WalkingController, History]) -> None:
    controller, history = lab
    assert controller.fall is None
    assert_followed(history)
    assert history["com"][-1, 0] - history["com"][0, 0] == pytest.approx(0.75, abs=2e-3)
    assert controller.planner == pw.FootstepPlanner(0.15, 0.1, 0.6)


def test_every_entry_has_a_row_per_dt(lab: tuple[WalkingController, History]) -> None:
    _, history = lab
    n = len(history["time"])
    assert history["time"] == pytest.approx(0.01 * np.arange(n))


def test_the_history_is_the_record(lab: tuple[WalkingController, History]) -> None:
    """The same names, shapes and values, every fifth of the ticks of 2 ms."""
    controller, history = lab
    record = controller.record
    assert record is not None
    assert set(history) == set(record.arrays())
    for name, rows in history.items():
        assert np.array_equal(rows, getattr(record, name)[::5], equal_nan=True)
    assert record.run.robot == controller.robot.name
    assert record.run.omega > 0.0


def test_what_is_measured_comes_from_mujoco(lab: tuple[WalkingController, History]) -> None:
    """The last tick is of the state in which `data` was 2 ms before its end, standing still."""
    controller, _ = lab
    model, data, record = controller.model, controller.data, controller.record
    assert record is not None
    mujoco.mj_forward(model, data)
    assert data.subtree_com[1] == pytest.approx(record.com[-1], abs=1e-5)
    for foot in ("left_foot", "right_foot"):
        assert data.site(foot).xpos == pytest.approx(getattr(record, foot)[-1, :3, 3], abs=1e-5)
    weight = 9.81 * float(model.body_mass.sum())
    carried = record.left_force[-1, 2] + record.right_force[-1, 2]
    assert carried == pytest.approx(weight, rel=1e-3)


def test_a_soles_wrench_is_about_its_centre(lab: tuple[WalkingController, History]) -> None:
    """So the ZMP of a single support lies on the sole, wherever in the world that is."""
    controller, _ = lab
    record, sole = controller.record, controller.robot.sole
    assert record is not None
    alone = (record.left_force[:, 2] > 300.0) & (record.right_force[:, 2] == 0.0)
    _, _, fz, mx, my, _ = record.left_force[alone].T
    assert np.abs(-my / fz).max() < sole.half_length
    assert np.abs(mx / fz).max() < sole.half_width
    zmp = record.left_foot[alone, :2, 3] + np.column_stack([-my / fz, mx / fz])
    assert zmp == pytest.approx(record.zmp[alone], abs=1e-3)


def test_the_supports_follow_each_other(lab: tuple[WalkingController, History]) -> None:
    """A foot in the air carries nothing, but for the moments of lift and landing."""
    _, history = lab
    for phase, swinging in ((1, "right_force"), (2, "left_force")):
        alone = history["phase_ref"] == phase
        assert alone.sum() == pytest.approx(3 * 48, abs=3)
        assert np.mean(history[swinging][alone, 2] < 1.0) > 0.95


def test_torques_stay_within_the_motors(lab: tuple[WalkingController, History]) -> None:
    controller, history = lab
    share = np.abs(history["tau"]).max(axis=0) / controller.robot.effort
    assert 0.1 < share.max() <= 1.0


def test_the_swing_lasts_the_single_support_and_starts_on_the_left(
    lab: tuple[WalkingController, History],
) -> None:
    plan = lab[0].plan
    assert plan is not None
    assert [step.foot for step in plan.steps] == ["left", "right"] * 3
    assert [step.land - step.lift for step in plan.steps] == pytest.approx([0.48] * 6)


def test_it_walks_on_from_where_the_robot_stands(spec: mujoco.MjSpec) -> None:
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:7] = 4.0, -2.0, 0.93, np.cos(1.0), 0.0, 0.0, np.sin(1.0)
    controller = WalkingController(model, data)
    first = controller.run_walking(2)
    ended = data.time
    second = controller.run_walking(2)
    assert_followed(first)
    assert_followed(second)
    way = second["com"][-1, :2] - first["com"][0, :2]
    assert way == pytest.approx((0.3 * np.cos(2.0), 0.3 * np.sin(2.0)), abs=5e-3)
    assert data.time == pytest.approx(2.0 * ended)


def test_the_model_is_not_changed(spec: mujoco.MjSpec) -> None:
    for motor in spec.actuators:
        motor.set_to_position(kp=200.0)
        motor.forcerange, motor.ctrlrange = motor.ctrlrange, (0.0, 0.0)
        motor.forcelimited, motor.ctrllimited = 1, 0
    model, untouched = spec.compile(), spec.compile()
    WalkingController(model, mujoco.MjData(model)).run_walking(1)
    assert model.opt.disableflags == untouched.opt.disableflags
    assert model.opt.timestep == untouched.opt.timestep
    assert np.array_equal(model.actuator_gainprm, untouched.actuator_gainprm)


def test_a_com_height_and_a_gait_of_ones_own(spec: mujoco.MjSpec) -> None:
    model = spec.compile()
    controller = WalkingController(model, mujoco.MjData(model), com_height=0.78)
    controller.planner = pw.FootstepPlanner(0.2, 0.14, 0.7)
    history = controller.run_walking(2, dt=0.004)
    assert_followed(history)
    assert history["com"][:, 2].mean() == pytest.approx(0.78, abs=2e-3)
    apart = history["left_foot"][0, 1, 3] - history["right_foot"][0, 1, 3]
    assert apart == pytest.approx(0.14, abs=1e-3)
    assert np.diff(history["time"]) == pytest.approx(0.004)


def test_soles_too_wide_for_the_labs_steps_are_set_further_apart(spec: mujoco.MjSpec) -> None:
    for foot in ("left_foot", "right_foot"):
        spec.geom(foot).size[1] = 0.06
    model = spec.compile()
    controller = WalkingController(model, mujoco.MjData(model))
    assert controller.planner.step_width == controller.robot.step_width > 0.12


def test_a_push_that_fells_it_is_told(spec: mujoco.MjSpec) -> None:
    model = spec.compile()
    data = mujoco.MjData(model)
    controller = WalkingController(model, data)
    data.body("torso").xfrc_applied[1] = 400.0
    with pytest.warns(
        UserWarning, match=r"^fell after \d\.\d\d s: the (CoM sank to|torso leaned) "
    ):
        history = controller.run_walking(2)
    assert controller.fall is not None
    assert history["time"][-1] <= controller.fall[0] < 4.0


def test_an_interval_between_physics_steps_is_refused(spec: mujoco.MjSpec) -> None:
    model = spec.compile()
    controller = WalkingController(model, mujoco.MjData(model))
    multiple = "dt must be a positive multiple of the model's timestep of 0.002 s, got {}."
    for dt, sentence in (
        *((dt, multiple.format(dt)) for dt in (0.003, 0.0, -0.01)),
        (np.nan, "dt must be finite (s), got nan."),
    ):
        with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
            controller.run_walking(6, dt)


def test_it_does_not_warn_when_it_walks(spec: mujoco.MjSpec) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        walk(spec, 0)


def lab_controller(spec: mujoco.MjSpec) -> WalkingController:
    model = spec.compile()
    return WalkingController(model, mujoco.MjData(model))


def test_what_a_walk_can_do_it_can_do_in_ones_own_model(spec: mujoco.MjSpec) -> None:
    """Plan, push, swing height and a callback; the push is in the record at its time."""
    controller = lab_controller(spec)
    start = controller.robot.step_width
    plan = pw.FootstepPlanner(0.15, max(0.1, start), 0.6).generate_footsteps(2)
    times: list[float] = []
    history = controller.run_walking(
        plan=plan,
        pushes=[pw.Push(2.0, 0.1, (20.0, 0.0, 0.0))],
        swing_height=0.1,
        on_tick=lambda walk: times.append(walk.time),
    )
    assert controller.fall is None
    record = controller.record
    assert record is not None
    assert times == pytest.approx(record.time)
    pushed = record.time[record.push[:, 0] > 0.0]
    assert (pushed.min(), pushed.max()) == pytest.approx((2.0, 2.1), abs=5e-3)
    assert [push["t"] for push in record.run.pushes] == [2.0]
    assert record.run.swing_height == 0.1
    lifted = history["left_foot"][:, 2, 3].max()
    assert lifted == pytest.approx(0.1, abs=5e-3)


def test_a_turning_walk(spec: mujoco.MjSpec) -> None:
    controller = lab_controller(spec)
    controller.planner = pw.FootstepPlanner(0.1, 0.16, 0.7)
    history = controller.run_walking(3, turn=0.1)
    assert_followed(history)
    (c, s) = history["left_foot"][-1, :2, 0]
    assert np.arctan2(s, c) == pytest.approx(0.2, abs=0.01)


def test_a_plan_elsewhere_is_refused(spec: mujoco.MjSpec) -> None:
    controller = lab_controller(spec)
    for start, off in (((0.63, 0.0), "0.600 m off"), ((0.03, 0.0, 1.57), "turned by 1.570 rad")):
        plan = pw.FootstepPlanner().generate_footsteps(2, start)
        with pytest.raises(InvalidInput, match=off) as told:
            controller.run_walking(plan=plan)
        assert told.value.argument == "plan"
    with pytest.raises(InvalidInput, match="turn must be left out beside a plan"):
        controller.run_walking(plan=pw.FootstepPlanner().generate_footsteps(2), turn=0.1)


def test_an_attribute_that_would_be_ignored_is_refused(spec: mujoco.MjSpec) -> None:
    controller = lab_controller(spec)
    for name in ("swing_height", "plan", "robot", "friction"):
        with pytest.raises(InvalidInput, match=f"^{name} of a WalkingController cannot be"):
            setattr(controller, name, 0.1)
    controller.com_height = 0.79
    assert controller.run_walking(0)["com"][-1, 2] == pytest.approx(0.79, abs=2e-3)
