"""The walking lab's classes, thin views on the rest of the library.

Imports everything below it; the lab's `FootstepPlanner` and `PreviewController` are those of
`footsteps` and `preview`. Start with `walking_controller`.
"""
