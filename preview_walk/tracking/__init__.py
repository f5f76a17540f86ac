"""Whole-body tracking: tasks and contacts in, joint torques out, one QP a tick.

Imports `robots`; it knows neither plans nor a simulator. Start with `whole_body`; what the QP is
and who solves it stands in `tracking.qp`.
"""
