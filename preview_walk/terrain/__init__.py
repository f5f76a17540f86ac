"""The ground as a value: its height and normal at any place, from slopes to stepping stones.

Imports `geometry` and numpy; it knows no robot and no simulator. Start with `ground` (what every
ground can tell), then `shapes` (grounds by name) and what they are made of: `slabs` and
`height_field`.
"""
