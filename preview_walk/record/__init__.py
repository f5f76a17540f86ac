"""The record of a run: planned beside measured at every tick, its plans, facts and figures.

Imports `geometry`, `terrain`, `footsteps` and numpy; who reads records needs no simulator. Start
with `fields` (every array, its shape and unit) and `run_facts` (what is no array), then `record`.
"""
