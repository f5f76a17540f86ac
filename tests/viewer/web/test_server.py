"""The page: its port, its host, what is missing, and what it leaves behind."""

from __future__ import annotations

import socket
import subprocess
import sys

import pytest

from preview_walk import extras
from preview_walk.errors import InvalidInput
from preview_walk.viewer.web.server import HOST, page, require_port, require_web


def test_a_page_is_for_this_machine_alone_and_ends_with_its_block(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with page() as made:
        port = made.get_port()
        assert made.get_host() == HOST == "127.0.0.1"
        socket.create_connection((HOST, port), 5).close()
        with pytest.raises(InvalidInput, match=f"^port must be free, got {port} at '127.0.0.1';"):
            require_port(port)
        with pytest.raises(InvalidInput, match="must be free"), page(port):
            pass
    assert require_port(port) == (port, HOST)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("port", [-1, 65536, 80.5, "8080", None, True, 10**400])
def test_a_port_that_cannot_be_is_told(port: object) -> None:
    with pytest.raises(InvalidInput, match=r"^port must be ") as told:
        require_port(port)
    assert told.value.argument == "port"


@pytest.mark.parametrize("host", ["", None, 7, "no such host.", "192.0.2.1", "x" * 300, "a\0b"])
def test_a_host_that_is_not_of_this_machine_is_told(host: object) -> None:
    with pytest.raises(InvalidInput, match=r"^host must be ") as told:
        require_port(0, host)
    assert told.value.argument == "host"


def test_what_is_missing_is_told_with_what_brings_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    with pytest.raises(InvalidInput) as told:
        require_web()
    assert str(told.value) == (
        "a walk in the browser needs viser, which is not installed; "
        "pip install 'preview-walk[web]' brings it."
    )


def test_nothing_of_a_page_is_imported_before_there_is_one() -> None:
    code = (
        "import sys, preview_walk as pw\n"
        "pw.show, pw.export_html, pw.simulate, pw.run_in_viewer\n"
        "print(sorted({'viser', 'mjviser', 'trimesh', 'websockets'} & set(sys.modules)))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
