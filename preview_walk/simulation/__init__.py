"""Walks in MuJoCo: plants that can be sensed and driven, and the one loop that drives them.

Imports everything down to `record`; it knows nothing of plots. Start with `walk`, then `plant`.
"""
