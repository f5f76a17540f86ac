"""Poses, support polygons, quintics and yaw arithmetic: no walking in it.

Imports numpy and scipy only. Start with `poses` (what a pose and a heading are), then `support`.
"""
