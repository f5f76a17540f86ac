# The public names, by what they are for: `__init__.py` loads each from here when it is first used.

__version__: str

from .analysis.plots import plot as plot
from .analysis.plots import plot_all as plot_all
from .analysis.plots import save_plot as save_plot
from .controller.robot_limits import command_limits as command_limits
from .controller.robot_limits import gait_limits as gait_limits

# Errors.
from .errors import InvalidInput as InvalidInput
from .errors import PreviewWalkError as PreviewWalkError
from .errors import RobotError as RobotError
from .files import OutputError as OutputError

# Footsteps: values, plans, planners, what legs can do.
from .footsteps.footstep import Footstep as Footstep
from .footsteps.gaits import arc as arc
from .footsteps.gaits import on_the_spot as on_the_spot
from .footsteps.gaits import sideways as sideways
from .footsteps.gaits import straight as straight
from .footsteps.gaits import turn_in_place as turn_in_place
from .footsteps.goals import from_list as from_list
from .footsteps.goals import to_pose as to_pose
from .footsteps.limits import GaitLimits as GaitLimits
from .footsteps.plan import FootstepPlan as FootstepPlan
from .footsteps.planner import FootstepPlanner as FootstepPlanner
from .footsteps.stride import Stride as Stride
from .footsteps.velocity import follow_velocity as follow_velocity

# The walking pattern: references as functions of a plan and time.
from .geometry.support import Sole as Sole

# The walking lab's classes.
from .lab.swing import SwingLegTrajectory as SwingLegTrajectory
from .lab.walking_controller import WalkingController as WalkingController
from .lab.zmp import ZMPTrajectoryGenerator as ZMPTrajectoryGenerator
from .offscreen import RenderError as RenderError
from .pattern.check import check_plan as check_plan
from .pattern.check import require_walkable as require_walkable
from .pattern.swing import Swing as Swing
from .pattern.zmp_reference import zmp_reference as zmp_reference

# Preview control, for any linear plant.
from .preview.cart_table import ComState as ComState
from .preview.cart_table import ComTrajectory as ComTrajectory
from .preview.cart_table import cart_table as cart_table
from .preview.compare import Comparison as Comparison
from .preview.compare import compare as compare
from .preview.comparison_plot import plot_comparison as plot_comparison
from .preview.controller import PreviewController as PreviewController
from .preview.design import PreviewDesign as PreviewDesign
from .preview.gains import preview_gains as preview_gains
from .preview.horizon import ShortHorizonWarning as ShortHorizonWarning
from .preview.limits import Limits as Limits
from .preview.mpc import PredictiveServo as PredictiveServo
from .preview.observer import kalman_gain as kalman_gain
from .preview.observer import luenberger_gain as luenberger_gain
from .preview.response import Tracking as Tracking
from .preview.response import preview_effect as preview_effect
from .preview.response import track as track
from .preview.servo import PreviewServo as PreviewServo
from .preview.systems import closed_loop_system as closed_loop_system
from .preview.systems import preview_filter as preview_filter
from .preview.systems import servo_system as servo_system
from .preview.zmp_mpc import zmp_mpc as zmp_mpc

# Records, figures, plots, films.
from .record.record import Record as Record
from .record.run_facts import RunFacts as RunFacts
from .record.summary import Summary as Summary
from .robots.inspection import inspect_robot as inspect_robot
from .robots.listing import list_robots as list_robots
from .robots.load import load_robot as load_robot

# Robots.
from .robots.robot import Robot as Robot
from .simulation.pushes import Push as Push
from .simulation.pushes import random_pushes as random_pushes

# Walks.
from .simulation.simulate import simulate as simulate
from .simulation.simulate import simulate_commands as simulate_commands
from .simulation.walk import Walk as Walk

# Tracking: tasks and contacts in, torques out.
from .tracking.dynamics import Dynamics as Dynamics
from .tracking.gains import TrackingGains as TrackingGains
from .tracking.tasks import Task as Task
from .tracking.whole_body import WholeBodyController as WholeBodyController
from .viewer.video import render_video as render_video
