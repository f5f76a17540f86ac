"""Plots of a run, from its record alone.

Imports `record`, `terrain`, `geometry` and matplotlib; it knows no controller. Start with `plots`,
which lists them all; each kind is drawn in a `*_plots` file of its own.
"""
