"""The CoM generators by name."""

from __future__ import annotations

from collections.abc import Callable

from preview_walk.errors import InvalidInput
from preview_walk.pattern.com.dcm import DcmGenerator
from preview_walk.pattern.com.generator import ComGenerator
from preview_walk.pattern.com.mpc import MpcGenerator
from preview_walk.pattern.com.preview import PreviewGenerator

DEFAULT = "preview"

COM_GENERATORS: dict[str, Callable[[float], ComGenerator]] = {
    "preview": PreviewGenerator,
    "mpc": MpcGenerator,
    "dcm": DcmGenerator,
}
"""Each is made for a cart-table of some height (m)."""


def com_generator(name: str, height: float) -> ComGenerator:
    """Return the CoM generator of that name for a cart-table of some height (m).

    Raises:
        InvalidInput: there is no generator of that name.
    """
    if not isinstance(name, str) or name not in COM_GENERATORS:
        raise InvalidInput(
            f"com_generator must be one of {', '.join(COM_GENERATORS)}, got {name!r}.",
            argument="com_generator",
        )
    return COM_GENERATORS[name](height)
