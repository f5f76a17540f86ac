"""What a walking robot can measure: a number beyond these bounds is a slip in its file."""

from __future__ import annotations

SMALLEST_SOLE = 0.01
"""Smallest length and width (m) that a sole may have."""

LARGEST = 1e3
"""Largest position, size (m) or angle (rad) that a file or a description may hold."""

LARGEST_MASS = 1e4
"""Largest mass (kg) of a body."""

LARGEST_GAIN = 1e6
"""Largest inertia, armature (kg·m²), damping (N·m·s/rad), friction or torque (N·m)."""

SMALLEST_EFFORT = 1e-3
"""Smallest torque (N·m) or speed (rad/s) that counts as one."""

MOST_LINKS = 1000
"""Most links of a URDF; the largest humanoids, with hands, have about two hundred."""

MOST_COPIES = 10_000
"""Most copies that an MJCF file may ask for by <replicate>, <composite> or <flexcomp>."""
