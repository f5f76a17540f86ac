"""The controls of a page, by their labels: a stand-in for who clicks on them."""

from __future__ import annotations

from typing import Any


def handle(server: Any, label: str) -> Any:
    """Return the control of the page that has this label."""
    handles = server.gui._gui_input_handle_from_uuid.values()
    (found,) = (one for one in handles if getattr(one, "label", None) == label)
    return found


def click(server: Any, label: str) -> None:
    """Click on the button of this label."""
    handle(server, label).value = True
