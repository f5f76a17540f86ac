"""A page without a browser: a real server on a free port, told that somebody looks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from preview_walk.viewer.web import pace
from preview_walk.viewer.web.server import page


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Return the server of an empty page that has a visitor; nobody waits for real time."""
    monkeypatch.setattr(pace, "sleep", lambda _: None)
    with page() as made:
        monkeypatch.setattr(made, "get_clients", lambda: {0: None})
        yield made
