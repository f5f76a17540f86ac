"""Reading a robot: descriptions, URDF, MJCF and meshes, with whatever they link to.

Imports `robots.finding.tree`, for what it returns, and geometry. Start with `source`, which turns
any of them into one model.
"""
