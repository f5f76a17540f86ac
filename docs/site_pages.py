"""The pages of the site that are made: parts of README and changelog, and the reference.

They go into `docs/site/`, which git ignores; `docs/conf.py` calls this before Sphinx reads.
"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
TABLE = ROOT / "preview_walk" / "__init__.pyi"

PARTS = {
    "start": ("# Start", "", "## The command"),
    "command": ("# The command", "## The command", "## How well it walks"),
    "figures": ("# How well it walks", "## How well it walks", "The largest push of 0.2 s"),
    "pushes": ("# Pushes", "The largest push of 0.2 s", "## Robots"),
    "robots": ("# Robots", "## Robots", "## The record"),
    "record": ("# The record, figures and plots", "## The record", "## What it does not do"),
    "limits": ("# Known limits", "## What it does not do", "## Development"),
}
"""Pages of parts of the README: title, and the lines where a part begins and ends."""


def write_site_pages(folder: Path) -> None:
    """Write the pages; those that say already what they would are left alone.

    Args:
        folder: where they go.
    """
    readme = (ROOT / "README.md").read_text(encoding="utf-8").removeprefix("# preview_walk\n")
    pages = {
        f"{name}.md": relinked(f"{title}\n\n{part_of(readme, first, last)}")
        for name, (title, first, last) in PARTS.items()
    }
    pages["changelog.md"] = relinked((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
    pages |= {f"api/{name}": text for name, text in reference().items()}
    for name, text in pages.items():
        write(folder / name, text)
    for old in (folder / "api").glob("*.md"):
        if f"api/{old.name}" not in pages:
            old.unlink()


def write(path: Path, text: str) -> None:
    """Write a page unless it says the same already, so that Sphinx does not read it again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def part_of(text: str, first: str, last: str) -> str:
    """Return what stands from the line that begins with `first` to that with `last`.

    A heading is left out, for the page has its own; other first lines stay.
    """
    lines = text.splitlines()
    begin = 0 if not first else next(i for i, line in enumerate(lines) if line.startswith(first))
    end = next(i for i, line in enumerate(lines) if line.startswith(last))
    return "\n".join(lines[begin + first.startswith("#") : end])


def relinked(text: str) -> str:
    """Return a page of the root as one of `docs/site/`: its links lead to the same places."""
    text = re.sub(r"\]\(docs/", "](../", text)
    text = re.sub(r"\]\(examples/(\w+)\.py\)", r"](gallery.md#\1)", text)
    return re.sub(r"\]\(((?:benchmarks|models)/[^)]*)\)", r"](../../\1)", text)


def groups() -> dict[str, dict[str, str]]:
    """Return by the comments of the table the public names below them, each with its module."""
    found: dict[str, dict[str, str]] = {}
    title = ""
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if line.startswith("# "):
            title = re.split(r"[:,.]", line[2:])[0]
        elif match := re.match(r"from (\.\S+) import \w+ as (\w+)", line):
            found.setdefault(title, {})[match[2]] = f"preview_walk{match[1]}"
    return found


def reference() -> dict[str, str]:
    """Return the pages of the reference by file: one for each group of names, and their list."""
    pages = {}
    for title, names in groups().items():
        if title.startswith("The public names"):
            continue
        entries = [f"```{{eval-rst}}\n{directive(*item)}\n```\n" for item in names.items()]
        file = re.sub(r"\W+", "-", title.lower()).strip("-")
        pages[f"{file}.md"] = f"# {title}\n\n" + "\n".join(entries)
    listed = "\n".join(name.removesuffix(".md") for name in pages)
    head = "# Reference\n\nEvery public name, by what it is for: `import preview_walk as pw`.\n\n"
    pages["index.md"] = f"{head}```{{toctree}}\n{listed}\n```\n"
    return pages


def directive(name: str, module: str) -> str:
    """Return the directive that shows a name, by what it is.

    Args:
        name: a public one.
        module: where it is from; what is said about a constant or an alias stands only there.
    """
    import preview_walk

    thing = getattr(preview_walk, name)
    if isinstance(thing, type):
        kind = "exception" if issubclass(thing, BaseException) else "class"
    elif callable(thing) and hasattr(thing, "__code__"):
        kind = "function"
    else:
        return f".. autodata:: {module}.{name}\n   :no-value:"
    return f".. auto{kind}:: preview_walk.{name}"
