"""Walks in MuJoCo: plants that can be sensed and driven, and the one loop that drives them.

Imports everything below it but `analysis`. Start with `walk`, the loop, then `plant`, what it
senses and drives: another sensor, motor or ground is part of a plant, as in `world`, ours.
"""
