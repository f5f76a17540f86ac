"""Plots of a run, from its record alone.

Imports `record` and matplotlib; it knows no controller. Start with `plots`.
"""
