"""The record of a run: planned beside measured at every tick, its plans, facts and figures.

Imports `geometry`, `footsteps` and numpy; whoever reads records needs no simulator. Start with
`fields` (every array, its shape and unit) and `run_facts` (what is no array), then `record`.
"""
