"""The largest push that a pendulum with stated reach, width, timing and swing speed survives.

Imports `geometry` and `preview`; benchmarks use it, the walker does not. Start with `bound`.
"""
