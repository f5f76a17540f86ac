# The public names, by what they are for: `__init__.py` loads each from here when it is first used.

__version__: str

# Preview control, for any linear plant.
from .preview.gains import preview_gains as preview_gains
from .preview.increments import with_increments as with_increments
from .preview.design import PreviewDesign as PreviewDesign
from .preview.horizon import ShortHorizonWarning as ShortHorizonWarning
from .preview.response import Tracking as Tracking
from .preview.response import preview_effect as preview_effect
from .preview.response import track as track
from .preview.servo import PreviewServo as PreviewServo
from .preview.limits import Limits as Limits
from .preview.observer import kalman_gain as kalman_gain
from .preview.observer import luenberger_gain as luenberger_gain
from .preview.systems import closed_loop_system as closed_loop_system
from .preview.systems import preview_filter as preview_filter
from .preview.systems import servo_system as servo_system
from .preview.mpc import PredictiveServo as PredictiveServo
from .preview.least_input import LeastInputServo as LeastInputServo
from .preview.compare import Comparison as Comparison
from .preview.compare import compare as compare
from .preview.comparison_plot import plot_comparison as plot_comparison
from .preview.cart_table import ComState as ComState
from .preview.cart_table import ComTrajectory as ComTrajectory
from .preview.cart_table import cart_table as cart_table
from .preview.controller import PreviewController as PreviewController
from .preview.zmp_mpc import zmp_mpc as zmp_mpc

# Poses, polygons and polynomials.
from .geometry.poses import midfeet as midfeet
from .geometry.poses import pose_at as pose_at
from .geometry.support import Sole as Sole
from .geometry.support import support_margin as support_margin
from .geometry.support import support_polygon as support_polygon
from .geometry.quintic import Quintic as Quintic

# Footsteps: values, plans, planners, what legs can do.
from .footsteps.footstep import Footstep as Footstep
from .footsteps.plan import FootstepPlan as FootstepPlan
from .footsteps.reading import as_plan as as_plan
from .footsteps.files import read_footsteps as read_footsteps
from .footsteps.files import write_footsteps as write_footsteps
from .footsteps.planner import FootstepPlanner as FootstepPlanner
from .footsteps.stride import Stride as Stride
from .footsteps.gaits import arc as arc
from .footsteps.gaits import on_the_spot as on_the_spot
from .footsteps.gaits import sideways as sideways
from .footsteps.gaits import straight as straight
from .footsteps.gaits import turn_in_place as turn_in_place
from .footsteps.goals import from_list as from_list
from .footsteps.goals import to_pose as to_pose
from .footsteps.velocity import follow_velocity as follow_velocity
from .footsteps.velocity import saturated as saturated
from .footsteps.limits import GaitLimits as GaitLimits

# The walking pattern: references as functions of a plan and time.
from .pattern.zmp_reference import zmp_reference as zmp_reference
from .pattern.swing import Swing as Swing
from .pattern.check import check_plan as check_plan
from .pattern.check import require_walkable as require_walkable

# The stabilizer: pure functions from measured state and reference to a decision.
from .stabilizer.com_feedback import com_feedback as com_feedback
from .stabilizer.disturbance import observe as observe
from .stabilizer.recovery import recover as recover
from .stabilizer.recovery_steps import SHORT_PAUSE as SHORT_PAUSE
from .stabilizer.step_adaptation import SPEED_SHARE as SPEED_SHARE
from .stabilizer.step_adaptation import adapt_step as adapt_step
from .stabilizer.step_limits import StepLimits as StepLimits
from .stabilizer.step_limits import step_limits as step_limits

# The largest push a pendulum can survive.
from .capturability.bound import Answer as Answer
from .capturability.bound import Direction as Direction
from .capturability.bound import PushGait as PushGait
from .capturability.bound import largest_impulse as largest_impulse

# Robots.
from .robots.robot import Robot as Robot
from .robots.load import load_robot as load_robot
from .robots.listing import list_robots as list_robots
from .robots.reading.description import catalogue as catalogue
from .robots.reading.description import models_folder as models_folder
from .robots.inspection import inspect_robot as inspect_robot
from .robots.standing import at_com_height as at_com_height
from .robots.standing import standing_configuration as standing_configuration
from .robots.state import to_mujoco as to_mujoco
from .robots.state import to_pinocchio as to_pinocchio

# Tracking and control: measured state and plan in, torques out.
from .tracking.dynamics import Dynamics as Dynamics
from .tracking.gains import TrackingGains as TrackingGains
from .tracking.tasks import Task as Task
from .tracking.whole_body import WholeBodyController as WholeBodyController
from .tracking.qp.problem import TickProblem as TickProblem
from .tracking.qp.solution import Backend as Backend
from .tracking.qp.solution import Solution as Solution
from .controller.robot_limits import command_limits as command_limits
from .controller.robot_limits import gait_limits as gait_limits
from .controller.walker import Walker as Walker

# Walks.
from .whole_walks import simulate as simulate
from .whole_walks import simulate_commands as simulate_commands
from .simulation.walk import Walk as Walk
from .simulation.pushes import Push as Push
from .simulation.pushes import random_pushes as random_pushes
from .simulation.plant import Plant as Plant
from .simulation.world import World as World
from .simulation.scene import Scene as Scene

# The robot as it is: sensors, motors, a model that is not quite it; and the estimator.
from .reality.realism import Realism as Realism
from .reality.realism import read_realism as read_realism
from .reality.sensors import Encoders as Encoders
from .reality.sensors import Imu as Imu
from .reality.sensors import SoleSensors as SoleSensors
from .reality.motors import Motors as Motors
from .reality.mismatch import Mismatch as Mismatch
from .reality.mismatch import Payload as Payload
from .reality.faults import Fault as Fault
from .simulation.real_world import RealWorld as RealWorld
from .estimation.base_filter import BaseFilter as BaseFilter
from .estimation.base_filter import FilterNoise as FilterNoise
from .estimation.estimator import Estimate as Estimate
from .estimation.estimator import Estimator as Estimator
from .estimation.estimator import SensorNoise as SensorNoise
from .estimation.measurement import Measurement as Measurement
from .estimation.sole_forces import ForceNoise as ForceNoise

# The ground.
from .footsteps.clearing import clearing_shape as clearing_shape
from .footsteps.swing_shape import SwingShape as SwingShape
from .footsteps.laying import lay_on as lay_on
from .terrain.ground import FlatGround as FlatGround
from .terrain.ground import Ground as Ground
from .terrain.ground import Plane as Plane
from .terrain.height_field import HeightField as HeightField
from .terrain.height_field import height_field as height_field
from .terrain.height_field import rough as rough
from .terrain.reading import read_ground as read_ground
from .terrain.shapes import Piece as Piece
from .terrain.shapes import blocks as blocks
from .terrain.shapes import path as path
from .terrain.shapes import ramps as ramps
from .terrain.shapes import slope as slope
from .terrain.shapes import stairs as stairs
from .terrain.shapes import stepping_stones as stepping_stones
from .terrain.slabs import Slab as Slab
from .terrain.slabs import SlabGround as SlabGround

# Records, figures, plots, films.
from .record.record import Record as Record
from .record.run_facts import RunFacts as RunFacts
from .record.sensed import Sensed as Sensed
from .record.plan_log import PlanLog as PlanLog
from .record.plan_log import PlanRevision as PlanRevision
from .record.summary import Summary as Summary
from .record.mcap_file import write_mcap as write_mcap
from .analysis.plots import figure as figure
from .analysis.plots import plot as plot
from .analysis.plots import plot_all as plot_all
from .analysis.plots import save_plot as save_plot
from .analysis.plots import top_view as top_view
from .analysis.top_view import draw_top_view as draw_top_view
from .viewer.video import FPS as FPS
from .viewer.video import frames as frames
from .viewer.video import render_video as render_video
from .viewer.web.export import export_html as export_html
from .viewer.web.show import show as show
from .viewer.window import run_in_viewer as run_in_viewer

# The walking lab's classes.
from .lab.swing import SwingLegTrajectory as SwingLegTrajectory
from .lab.walking_controller import WalkingController as WalkingController
from .lab.zmp import ZMPTrajectoryGenerator as ZMPTrajectoryGenerator

# Campaigns.
from .studies.study import Study as Study
from .studies.margin import Margin as Margin
from .studies.walk_case import loaded_robot as loaded_robot
from .studies.walk_case import walk_case as walk_case
from .studies.reading import read_study as read_study
from .studies.results import Results as Results
from .studies.results import read_results as read_results
from .studies.campaign import VersionsWarning as VersionsWarning
from .studies.report import write_report as write_report
from .studies.pictures import heat_map as heat_map
from .studies.pictures import polar_plot as polar_plot

# Types and errors.
from .types import Array as Array
from .types import FEET as FEET
from .types import Foot as Foot
from .types import other as other
from .errors import InvalidInput as InvalidInput
from .errors import PreviewWalkError as PreviewWalkError
from .errors import RobotError as RobotError
from .files import OutputError as OutputError
from .offscreen import RenderError as RenderError
