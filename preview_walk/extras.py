"""What comes with the extras of `pyproject.toml`, and what to install where it is missing."""

from __future__ import annotations

from importlib.util import find_spec

from preview_walk.errors import InvalidInput


def require(what: str, extra: str, *modules: str) -> None:
    """Check that the modules of an extra are installed.

    Args:
        what: needs them, as the sentence begins.
        extra: that brings them.
        modules: by the names that are imported.

    Raises:
        InvalidInput: one is not there; says how to install it.
    """
    for module in modules:
        if find_spec(module) is None:
            raise InvalidInput(
                f"{what} needs {module}, which is not installed; "
                f"pip install 'preview-walk[{extra}]' brings it."
            )
