"""Reading a robot: descriptions, URDF, MJCF and meshes, with whatever they link to.

Imports MuJoCo and the errors. Start with `source`, which turns any of them into one model.
"""
