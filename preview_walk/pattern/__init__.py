"""The walking pattern: ZMP, CoM, DCM and swing foot as functions of a plan and time.

Imports `geometry`, `preview`, `terrain` and `footsteps`; it knows no robot and no simulator. Start
with `walking_pattern`, which puts the rest together for a tick; `com` holds what leads the CoM.
"""
