"""From measured state and reference to a wanted ZMP, a CoM acceleration or another plan.

Pure functions: a decision is returned, nothing is changed. Imports `geometry`, `footsteps` and
`pattern`; start with `com_feedback`, then `recovery` for how a push is answered.
"""
