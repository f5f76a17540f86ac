"""`show`: a walk in the browser, live or from a record."""

from __future__ import annotations

import sys

from preview_walk.arguments import function_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.walk import Progress, Walk
from preview_walk.viewer.video import require_pictures
from preview_walk.viewer.web.live import run_live
from preview_walk.viewer.web.replay import run_replay
from preview_walk.viewer.web.server import HOST, PORT, page
from preview_walk.viewer.web.stage import robot_of


def show(
    record_or_walk: Record | Walk,
    *,
    port: int = PORT,
    host: str = HOST,
    robot: Robot | None = None,
    progress: Progress | None = None,
) -> None:
    """Show a walk in the browser until its page ends it, or Ctrl-C; says the address on stderr.

    A `Walk` walks on in real time while a page is open: sliders command its velocity, a button
    pushes it, others change gains, pause it and let it make one tick. A `Record` is played.

    Args:
        record_or_walk: what to show.
        port: of the page; 0 for any that is free.
        host: name or address at which it is reached. "127.0.0.1" is this machine alone; "0.0.0.0"
            is every machine that can reach this one, and all of them may command the walk.
        robot: that of a record, where it is not in the catalogue.
        progress: called now and then with the time of a walk and its end (s).

    Raises:
        InvalidInput: neither a record nor a walk, a port or host that cannot be, a record that
            cannot be shown, or viser is not installed.
    """
    function_of(progress, "progress")
    if isinstance(record_or_walk, Record):
        record = record_or_walk
        body = robot_of(record, robot)
        require_pictures(record, body)
        with page(port, host) as server:
            _tell(host, server.get_port())
            run_replay(record, body, server)
    elif isinstance(record_or_walk, Walk):
        with page(port, host) as server:
            _tell(host, server.get_port())
            run_live(record_or_walk, server, progress)
    else:
        raise InvalidInput(
            f"show needs a Record or a Walk, got {shown(record_or_walk)}.", "record_or_walk"
        )


def _tell(host: str, port: int) -> None:
    name = f"[{host}]" if ":" in host else host
    print(f"See http://{name}:{port} in a browser; Ctrl-C ends it.", file=sys.stderr, flush=True)
