"""The site's pages that are made: no public name is missing, and parts of the README are whole."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

import preview_walk as pw

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def site() -> ModuleType:
    """Return the script that makes the pages."""
    spec = importlib.util.spec_from_file_location("site_pages", ROOT / "docs" / "site_pages.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_reference_has_every_public_name_once(site: ModuleType) -> None:
    text = "\n".join(site.reference().values())
    shown = re.findall(r"auto\w+:: preview_walk\.(?:[\w.]+\.)?(\w+)", text)
    public = [name for name in dir(pw) if not name.startswith("_")]
    assert sorted(shown) == sorted(public)


def test_no_section_of_the_readme_is_left_out(site: ModuleType, tmp_path: Path) -> None:
    site.write_site_pages(tmp_path)
    pages = "\n".join(path.read_text() for path in tmp_path.glob("*.md"))
    readme = (ROOT / "README.md").read_text().split("## Development")[0]
    for line in readme.splitlines():
        if line and not line.startswith("#"):
            assert site.relinked(line) in pages


def test_every_link_of_a_made_page_leads_somewhere(site: ModuleType, tmp_path: Path) -> None:
    site.write_site_pages(tmp_path)
    for page in tmp_path.glob("*.md"):
        for link in re.findall(r"\]\(([^)#\s]+)\)", page.read_text()):
            if not re.match(r"https?:|#", link):
                assert (ROOT / "docs" / "site" / link).resolve().exists(), (page.name, link)


def test_every_page_of_the_site_is_in_its_contents(site: ModuleType) -> None:
    index = (ROOT / "docs" / "index.md").read_text()
    listed = {line for line in index.splitlines() if re.fullmatch(r"[\w/-]+", line)}
    pages = {
        path.relative_to(ROOT / "docs").with_suffix("").as_posix()
        for path in (ROOT / "docs").glob("**/*.md")
        if not re.match(r"_build|site|jupyter", path.relative_to(ROOT / "docs").as_posix())
    }
    made = {f"site/{name}" for name in (*site.PARTS, "changelog", "gallery", "api/index")}
    assert listed == (pages | made) - {"index"}
