"""Where the CoM goes over a plan: three generators, one protocol.

Imports `preview`, `footsteps`, `geometry` and the plain functions of `pattern`; it knows no robot
and no simulator. Start with `generator`, the protocol, then `sampled_plan`, what every generator
follows; `table` names them.
"""
