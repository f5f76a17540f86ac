"""The largest push a walking pendulum can survive: the bound that pushes are measured against.

Imports `geometry` and `preview`; benchmarks use it, the walker does not. Start with `bound`.
"""
