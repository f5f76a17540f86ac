"""One HTML file: all in it, the walk as recorded, nothing from elsewhere."""

from __future__ import annotations

import base64
import re
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
import zstandard

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web.export import export_html
from preview_walk.viewer.web.picture import PICTURES


@pytest.fixture(scope="module")
def walked(talos: Robot) -> Record:
    """Return a second of standing and stepping on a slope."""
    walk = pw.Walk.standing(talos, ground=pw.slope(6))
    walk.command(0.3, 0.0, 0.0)
    return walk.run(until=1.0).record()


def film_of(html: str) -> dict[str, Any]:
    """Return the recording that the page plays."""
    (data,) = re.findall(r'__VISER_EMBED_DATA__="([A-Za-z0-9+/=]+)"', html)
    packed = base64.b64decode(data)[8:]
    inner = zstandard.ZstdDecompressor().decompressobj().decompress(packed)
    size = int.from_bytes(inner[:8], "little")
    film: dict[str, Any] = msgspec.msgpack.decode(inner[8 : 8 + size], strict=False)
    return film


def test_the_page_plays_the_record_and_loads_nothing(
    walked: Record, talos: Robot, tmp_path: Path
) -> None:
    path = export_html(walked, tmp_path / "walk.html")
    assert path == tmp_path / "walk.html"
    html = path.read_text("utf-8")
    assert not re.search(r'(?:src|href)\s*=\s*["\']?https?:', html)
    assert "@import" not in html.split("__VISER_EMBED_DATA__")[0]
    film = film_of(html)
    assert film["durationSeconds"] == pytest.approx(walked.time[-1], abs=1.5 / PICTURES)
    base = {}
    for time, message in film["messages"]:
        if message["type"] == "SetPositionMessage" and message["name"] == "/world/base_link_1":
            base[round(time * PICTURES)] = message["position"]
    assert len(base) > 0.9 * PICTURES
    for picture in (5, 20):
        tick = int(np.searchsorted(walked.time, picture / PICTURES - 1e-9))
        np.testing.assert_allclose(base[picture], walked.qpos[tick, :3], atol=1e-6)


def test_what_cannot_be_written_or_shown_is_told(
    walked: Record, talos: Robot, tmp_path: Path
) -> None:
    with pytest.raises(OutputError):
        export_html(walked, tmp_path / "no such folder" / "walk.html", talos)
    unknown = walked.with_run(robot="mine")
    with pytest.raises(InvalidInput, match="robot must be given for a record of 'mine'"):
        export_html(unknown, tmp_path / "walk.html")
    assert list(tmp_path.iterdir()) == []
