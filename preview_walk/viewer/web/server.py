"""The page: a server of viser's on a port of this machine, its camera, and nothing else."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from errno import EADDRINUSE
from typing import TYPE_CHECKING

from preview_walk.arguments import count_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.extras import require

if TYPE_CHECKING:
    from viser import ViserServer

PORT = 8080
HOST = "127.0.0.1"
"""This machine alone: who may open the page may command the walk."""

TITLE = "preview_walk"

LARGEST_PORT = 65535


def require_web() -> None:
    """Raise `InvalidInput` where the packages of a page are not installed."""
    require("a walk in the browser", "web", "viser", "mjviser")


def require_port(port: object, host: object = HOST) -> tuple[int, str]:
    """Return a port and a host at which a page can be served now.

    Raises:
        InvalidInput: a port that cannot be or is taken, or a host that is not of this machine.
    """
    number = count_of(port, "port", LARGEST_PORT)
    family = _family(host)
    with socket.socket(family, socket.SOCK_STREAM) as trial:
        trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            trial.bind((host, number))
        except PermissionError:
            raise InvalidInput(
                f"port must be one that this user may open, from 1024 on, got {number}.", "port"
            ) from None
        except OSError as error:
            at_fault = "port" if error.errno == EADDRINUSE else "host"
            what = "free" if at_fault == "port" else "an address of this machine"
            raise InvalidInput(
                f"{at_fault} must be {what}, got {number} at {shown(host)}; "
                "0 takes any port that is free.",
                at_fault,
            ) from None
    return number, str(host)


def _family(host: object) -> socket.AddressFamily:
    """Return the kind of a host's address; raises `InvalidInput` for what is no host."""
    try:
        if not isinstance(host, str) or not host:
            raise OSError
        return socket.getaddrinfo(host, 0, type=socket.SOCK_STREAM)[0][0]
    except (OSError, UnicodeError, ValueError):
        raise InvalidInput(
            f"host must be a name or an address of this machine, got {shown(host)}.", "host"
        ) from None


@contextmanager
def page(port: int = 0, host: str = HOST) -> Iterator[ViserServer]:
    """Serve an empty page until the end of the block.

    Args:
        port: of this machine; 0 for any that is free.
        host: by which name or address it can be reached.

    Raises:
        InvalidInput: a port or host that cannot be, or viser is not installed.
    """
    require_web()
    port, host = require_port(port, host)
    from viser import ViserServer

    with _quiet():
        server = ViserServer(host, port, label=TITLE, verbose=False)
    try:
        if port and server.get_port() != port:  # taken meanwhile; viser goes on to the next
            require_port(port, host)
            raise InvalidInput(f"port must be free, got {port} at {host}.", "port")
        server.gui.configure_theme(show_logo=False, show_share_button=False)
        server.gui.main_panel.dock_right()
        yield server
    finally:
        with _quiet():
            server.stop()


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep viser from printing its own banner."""
    from rich import get_console

    console = get_console()
    before, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = before
