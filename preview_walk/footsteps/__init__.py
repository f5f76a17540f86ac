"""Footsteps as values, the plans made of them, and the planners that make plans.

Imports `geometry` and, to lay plans on a ground, `terrain`; it knows no robot and no simulator.
Start with `footstep` and `plan`, then `planner` for a walk of equal steps, `velocity` for one by
command, `reading` for plans that others have written, and `handover` for whether a plan may replace
the one that is walked.
"""
