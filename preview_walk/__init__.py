"""Humanoid walking by LQR preview control and whole-body quadratic programming.

`__init__.pyi` holds the table of the public names, by what they are for. Each is loaded when it is
first used: planning alone needs no simulator, and a wrong option of the command is told at once.
"""

from importlib.metadata import PackageNotFoundError, version

import lazy_loader

try:
    __version__ = version("preview-walk")
except PackageNotFoundError:  # a checkout on the path, not installed
    __version__ = "0+unknown"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
