"""The walking lab's classes, thin views on the rest of the library.

Imports everything below the command. Start with `walking_controller`.
"""
