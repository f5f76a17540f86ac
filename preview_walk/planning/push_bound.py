"""The largest push a walking biped can survive, under the linear inverted pendulum.

A yardstick for push recovery: what the pendulum allows, whatever the controller. It is optimistic
(no delay, no friction, joint or torque limit, feet that land where they are wanted) and it leaves
out angular momentum, with which a body can go past it.

The push is a constant force F for D = 0.2 s. It moves the DCM as an instant impulse J would,

    jump = F / (m omega) * integral over the push of exp(-omega t) dt = J / (m omega),
    F D = J * omega D / (1 - exp(-omega D)),

seen from its first instant, with the CoP free to react from then on, also before the push is
over. `capture_program` finds the largest jump that strides at given times capture; here the
strides of a gait are put together and their times are searched. Before the push the gait is
periodic: the CoP rests in the middle of the sole in single support and moves at constant speed
from sole to sole in double support; the swing foot's way through the air follows 3 s^2 - 2 s^3.

Frame: origin at the stance sole (standing: midway between the soles), x forward, y towards the
stance foot's side, i.e. the heading's frame when the left foot stands and its mirror image when
the right foot does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import product
from math import cos, exp, expm1, hypot, inf, isfinite, pi, sin
from typing import Literal, get_args

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.planning.capture_program import Capture, Polygon, Stride, largest_jump
from preview_walk.planning.cart_table import natural_frequency
from preview_walk.planning.support import Sole
from preview_walk.types import Array

Answer = Literal["cop", "steps", "steps_and_timing"]
"""What may answer a push: CoP alone, also the footholds, also the times of the steps."""

Direction = Literal["forward", "back", "outward", "inward"]
"""Outward is towards the stance foot's side, inward towards the swing foot's."""

PUSH_DURATION = 0.2
"""Duration of the push (s)."""

MOST_STEPS = 6
"""Steps within which the DCM must be captured."""

_ANGLES = {"forward": 0.0, "outward": 0.5 * pi, "back": pi, "inward": -0.5 * pi}
# Who stands may shift the weight before the first foot lifts: by 0, 0.05, ... 0.3 s.
_LIFT_DELAYS = tuple(0.05 * i for i in range(7))
