"""The gallery: every example is run, and its page shows its code, what it printed, its pictures.

`docs/conf.py` calls this before Sphinx reads; what has not changed since, the package included, is
not run again. Examples with pages of their own, and those of minutes, are named with the command.
"""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path

from site_pages import ROOT, write

EXAMPLES = ROOT / "examples"

ARGUMENTS = {"pushes_study": ["6"]}
"""Of examples that would run for minutes: they do a part."""

NOT_RUN = ("video", "preview_horizon")
"""A film takes minutes without a graphics card, and so does a sweep of walks."""


def write_gallery(folder: Path) -> None:
    """Run the examples and write the page and its pictures.

    Args:
        folder: where they go.

    Raises:
        RuntimeError: an example fails; with what it said.
    """
    folder.mkdir(parents=True, exist_ok=True)
    package = sha256(b"".join(p.read_bytes() for p in sorted(ROOT.rglob("preview_walk/**/*.py"))))
    examples = sorted(EXAMPLES.glob("*.py"))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        done = [pool.submit(section, path, folder, package.hexdigest()) for path in examples]
        parts = [part.result() for part in done]
    head = (
        "# Gallery\n\nEvery example of `examples/`, run when this page was made: what it does, "
        "what it prints, what it draws.\n\n"
    )
    write(folder / "gallery.md", head + "\n".join(parts))


def section(path: Path, folder: Path, package: str) -> str:
    """Return an example's part of the page; run it if it has changed."""
    source = path.read_text(encoding="utf-8")
    title, _, story = (ast.get_docstring(ast.parse(source)) or path.stem).partition("\n")
    pictures = folder / "pictures" / path.stem
    said = pictures / "said.txt"
    stamp = sha256(f"{package}{source}".encode()).hexdigest()
    if path.stem not in NOT_RUN and not _is_current(said, stamp):
        run(path, pictures, stamp)
    lines = [f"({path.stem})=", f"## {path.stem.replace('_', ' ')}", "", title, ""]
    lines += [story.split("python examples/")[0].strip(), ""]
    if path.stem in NOT_RUN:
        lines += [f"Not run here, for it takes minutes: `python examples/{path.name}`.", ""]
    for picture in sorted(pictures.glob("*.png")):
        at = picture.relative_to(folder).as_posix()
        lines += [f"![What {path.stem} draws]({at})", ""]
    if said.exists():
        text = "\n".join(said.read_text(encoding="utf-8").splitlines()[1:])
        lines += ["```text", text.rstrip(), "```", ""]
    summary = f"<details><summary>examples/{path.name}</summary>"
    return "\n".join(
        [*lines, summary, "", "```python", source.rstrip(), "```", "", "</details>", ""]
    )


def run(path: Path, pictures: Path, stamp: str) -> None:
    """Run an example in an empty folder; keep its pictures and what it printed."""
    with tempfile.TemporaryDirectory() as folder:
        found = subprocess.run(
            [sys.executable, str(path), *ARGUMENTS.get(path.stem, [])],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        if found.returncode:
            raise RuntimeError(f"{path.name} failed:\n{found.stderr}")
        shutil.rmtree(pictures, ignore_errors=True)
        pictures.mkdir(parents=True)
        for picture in Path(folder).rglob("*.png"):
            shutil.copy(picture, pictures / picture.name)
        (pictures / "said.txt").write_text(f"{stamp}\n{found.stdout}", encoding="utf-8")


def _is_current(said: Path, stamp: str) -> bool:
    return said.exists() and said.read_text(encoding="utf-8").splitlines()[:1] == [stamp]
