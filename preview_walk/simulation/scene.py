"""The user's scene: a robot in a MuJoCo model and data of somebody else, sensed and driven."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
import pinocchio as pin

from preview_walk.arguments import instance_of, positive_number
from preview_walk.constants import GRAVITY
from preview_walk.errors import InvalidInput, RobotError, about
from preview_walk.robots.finding.constraints import holding_constraints
from preview_walk.robots.finding.tree import Tree
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco, to_pinocchio
from preview_walk.simulation.pushes import Push, Pusher
from preview_walk.simulation.scene_ground import scene_ground
from preview_walk.simulation.world import FRICTION
from preview_walk.types import FEET, Array, Foot

_FREE = int(mujoco.mjtJoint.mjJNT_FREE)
_JOINT = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
_CLAMP = int(mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL)


class Scene:
    """A robot in a MuJoCo model that somebody else made, with whatever else is in it; a `Plant`.

    Torques reach the joints through the model's own actuators: motors, or position and velocity
    servos, whose set point is chosen at every physics step such that they give the torque asked
    for. Joint springs are made up for. A sole's wrench is summed over MuJoCo's contacts.

    Attributes:
        robot, ground, friction, timestep, q, v, wrench, pushes, push: see `Plant`; the friction
            is that between floor and feet, and not believed where it is more than `World`'s.
        model, data: the user's; only `data` changes.
    """

    def __init__(
        self,
        robot: Robot,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        pushes: Sequence[Push] = (),
    ) -> None:
        """Find the robot and its floor in the scene.

        Args:
            robot: `load_robot(model)`.
            model: the scene.
            data: its state.
            pushes: forces on bodies of the scene, in the walk's time.

        Raises:
            RobotError: the model has no floor, another gravity, a constraint that holds the robot,
                or actuators or a base that cannot be driven so.
            InvalidInput: a push on an unknown body.
        """
        self.robot = instance_of(robot, Robot, "robot")
        self.model = instance_of(model, mujoco.MjModel, "model")
        self.data = instance_of(data, mujoco.MjData, "data")
        if data.model is not model:
            raise InvalidInput("data must be made of the model, got that of another.", "data")
        with about("model"):
            self._find()
        self.q: Array = np.array(robot.posture)
        self.v: Array = np.zeros(robot.pin.nv)
        self.wrench: dict[Foot, Array] = {foot: np.zeros(6) for foot in FEET}
        self.push: Array = np.zeros(3)
        self._pusher = Pusher(model, pushes, robot.blueprint.parts.base)
        self._since = 0.0  # the walk's time less the scene's own
        self._kinematics = robot.pin.createData()

    def _find(self) -> None:
        """Find base, joints, floor and actuators in the model."""
        robot, model = self.robot, self.model
        tree, base = Tree(model), robot.blueprint.parts.base
        root = int(model.body_jntadr[base]) if base < model.nbody else -1
        if root < 0 or int(model.jnt_type[root]) != _FREE:
            raise RobotError(f"the base '{tree.name(base)}' must have a free joint to walk with")
        held = holding_constraints(tree, base)
        if held:
            raise RobotError(f"the scene holds the robot by {' and '.join(held)}; expected it free")
        if not np.allclose(model.opt.gravity, (0.0, 0.0, -GRAVITY)):
            raise RobotError(
                f"gravity must be (0, 0, -{GRAVITY}) m/s^2, got {model.opt.gravity.tolist()}"
            )
        ids = {tree.joint_name(joint): joint for joint in range(model.njnt)}
        if missing := [name for name in robot.joint_names if name not in ids]:
            raise RobotError(f"the model has no joint '{missing[0]}' of the robot {robot.name}")
        joints = np.array([ids[name] for name in robot.joint_names])
        first, dof = int(model.jnt_qposadr[root]), int(model.jnt_dofadr[root])
        self._qpos = np.concatenate([np.arange(first, first + 7), model.jnt_qposadr[joints]])
        self._qvel = np.concatenate([np.arange(dof, dof + 6), model.jnt_dofadr[joints]])
        self._feet = _parts(robot, tree)
        self.ground, friction = scene_ground(tree, self._feet)
        self.friction = min(FRICTION, friction)
        self.timestep = positive_number(model.opt.timestep, "the model's timestep", "s")
        self._gain, self._actuator = _actuators(tree, joints)
        self._driven = self._actuator >= 0

    def __repr__(self) -> str:
        return f"Scene({self.robot.name}, {1.0 / self.timestep:g} Hz, friction {self.friction:g})"

    def __getstate__(self) -> dict[str, Any]:
        """Leave out Pinocchio's workspace, which the next `sense` fills."""
        return {name: value for name, value in vars(self).items() if name != "_kinematics"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the state and make the workspace anew."""
        vars(self).update(state)
        self._kinematics = self.robot.pin.createData()

    @property
    def pushes(self) -> tuple[Push, ...]:
        """The forces on bodies of the scene, those added under way among them."""
        return self._pusher.pushes

    def add_push(self, push: Push) -> None:
        """Push a body beside what was known beforehand; `InvalidInput` for an unknown one."""
        self._pusher.add(push)

    def place(self, q: Array, t: float) -> None:
        """Stand the robot still in configuration q (nq,) at time t (s) of the walk.

        The scene's own clock goes on from where it is.
        """
        qpos, qvel = np.empty_like(q), np.zeros(len(self._qvel))
        to_mujoco(q, qvel, qpos, qvel)
        self.data.qpos[self._qpos], self.data.qvel[self._qvel] = qpos, qvel
        mujoco.mj_forward(self.model, self.data)
        self._since = t - float(self.data.time)

    def sense(self) -> None:
        """Read the state and the contacts into `q`, `v` and `wrench`."""
        to_pinocchio(self.data.qpos[self._qpos], self.data.qvel[self._qvel], self.q, self.v)
        for foot, sole in self.soles().items():
            self.wrench[foot][:] = self._felt(foot, sole[:3, 3])

    def soles(self) -> dict[Foot, Array]:
        """Return the poses (4, 4) of the soles, world, m, in the configuration last sensed."""
        pin.framesForwardKinematics(self.robot.pin, self._kinematics, self.q)
        frames = self._kinematics.oMf
        return {foot: frames[self.robot.soles[foot].frame].homogeneous for foot in FEET}

    def _felt(self, foot: Foot, centre: Array) -> Array:
        """Return the wrench (6,) of all contacts of a foot about a point (3,), world axes."""
        total, felt = np.zeros(6), np.empty(6)
        for index, contact in enumerate(self.data.contact):
            for geom, sign in ((int(contact.geom[0]), -1.0), (int(contact.geom[1]), 1.0)):
                if self._feet.get(geom) != foot:
                    continue
                mujoco.mj_contactForce(self.model, self.data, index, felt)
                # MuJoCo gives what the first geom does to the second, in the contact's axes.
                axes = sign * contact.frame.reshape(3, 3)
                force = felt[:3] @ axes
                total[:3] += force
                total[3:] += np.cross(contact.pos - centre, force) + felt[3:] @ axes
        return total

    def step(self, torques: Array, steps: int) -> None:
        """Hold the joint torques (n,) in N·m for a number of physics steps."""
        model, data = self.model, self.data
        gear, gain, offset, pull, brake = self._gain
        dofs, places = self._qvel[6:], self._qpos[7:]
        servos = bool((pull != 0.0).any() or (brake != 0.0).any())
        flags = int(model.opt.disableflags)
        if servos:  # a servo's set point may lie where the joint may not
            model.opt.disableflags = flags | _CLAMP
        for _ in range(steps):
            self.push = self._pusher.apply(data.time + self._since, data)
            force = (torques - data.qfrc_spring[dofs]) / gear - offset
            force -= pull * gear * data.qpos[places] + brake * gear * data.qvel[dofs]
            data.ctrl[self._actuator[self._driven]] = (force / gain)[self._driven]
            mujoco.mj_step(model, data)
        model.opt.disableflags = flags


def _parts(robot: Robot, tree: Tree) -> dict[int, Foot]:
    """Return which foot each geom (id) of the feet belongs to."""
    feet: dict[int, Foot] = {}
    for foot in FEET:
        bodies = set(tree.below(robot.blueprint.parts.feet[foot]))
        for geom in range(tree.mj.ngeom):
            if int(tree.mj.geom_bodyid[geom]) in bodies:
                feet[geom] = foot
    return feet


def _actuators(tree: Tree, joints: Array) -> tuple[Array, Array]:
    """Return gear, gain and the three bias terms (5, n) of the joints' actuators, and their ids.

    The id is -1 for a joint that has none. An actuator's force, times gear its torque, is
    gain x control + bias[0] + bias[1] x position + bias[2] x velocity.
    """
    mj = tree.mj
    terms = np.zeros((5, len(joints)))
    terms[:2] = 1.0
    ids = np.full(len(joints), -1)
    place = {int(joint): at for at, joint in enumerate(joints)}
    for actuator in range(mj.nu):
        at = place.get(int(mj.actuator_trnid[actuator, 0]))
        if at is None or int(mj.actuator_trntype[actuator]) not in _JOINT:
            continue
        name = str(mj.actuator(actuator).name) or f"actuator_{actuator}"
        if ids[at] >= 0:
            raise RobotError(
                f"the joint '{tree.joint_name(int(joints[at]))}' has two actuators; expected one"
            )
        affine = int(mj.actuator_biastype[actuator]) == int(mujoco.mjtBias.mjBIAS_AFFINE)
        simple = (
            (affine or int(mj.actuator_biastype[actuator]) == int(mujoco.mjtBias.mjBIAS_NONE))
            and int(mj.actuator_gaintype[actuator]) == int(mujoco.mjtGain.mjGAIN_FIXED)
            and int(mj.actuator_dyntype[actuator]) == int(mujoco.mjtDyn.mjDYN_NONE)
            and mj.actuator_gainprm[actuator, 0] * mj.actuator_gear[actuator, 0] != 0.0
        )
        if not simple:
            raise RobotError(
                f"the actuator '{name}' cannot give a torque at once; "
                "expected a motor, or a position or velocity servo"
            )
        terms[:2, at] = mj.actuator_gear[actuator, 0], mj.actuator_gainprm[actuator, 0]
        if affine:
            terms[2:, at] = mj.actuator_biasprm[actuator, :3]
        ids[at] = actuator
    return terms, ids
