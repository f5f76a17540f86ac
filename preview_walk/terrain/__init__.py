"""The ground as a value: its height and normal at any place.

Imports numpy only; it knows no robot and no simulator. Start with `ground`.
"""
