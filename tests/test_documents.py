"""The documents' code is what is run, and what they print is what it prints."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[1]


def preview_pages() -> ModuleType:
    """Return the script that makes the pages."""
    spec = importlib.util.spec_from_file_location("preview_pages", ROOT / "docs/preview_pages.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


SCRIPT = preview_pages()


def block(page: str, part: str) -> str:
    """Return what stands between the marks of a part of a page."""
    text = (ROOT / "docs" / "preview" / f"{page}.md").read_text("utf-8")
    found = re.search(rf"<!-- {part} -->\n```\w+\n(.*?)\n```\n<!-- /{part} -->", text, re.DOTALL)
    assert found is not None
    return found[1]


def numbers_and_words(output: str) -> tuple[list[float], list[str]]:
    """Return the numbers of an output but the times of a sample, which no two machines share."""
    numbers, words, timed = [], [], -1
    for line in output.splitlines():
        cells = line.split()
        if "us/sample" in cells:
            timed = len(cells) - cells.index("us/sample")
        elif cells[0] not in ("LQR", "LQI", "preview", "MPC", "Wieber"):
            timed = -1
        for i, cell in enumerate(cells):
            if len(cells) - i == timed:
                continue
            if re.fullmatch(r"-?[\d.]+(e[-+]\d+)?", cell):
                numbers.append(float(cell))
            else:
                words.append(cell)
    return numbers, words


@pytest.mark.parametrize("page", SCRIPT.PAGES, ids=lambda page: page.name)
def test_a_page_shows_its_example_and_what_it_prints(page: object, tmp_path: Path) -> None:
    name = page.name  # type: ignore[attr-defined]
    assert block(name, "code") == SCRIPT.code_of(page)
    picture = tmp_path / "picture.png"
    found, shown = SCRIPT.output_of(page, picture), block(name, "output")
    assert picture.exists()
    numbers, words = numbers_and_words(shown)
    again, same_words = numbers_and_words(found)
    assert words == same_words
    # Another CPU rounds otherwise; an error of 1e-9 beside a limit is printed with all its digits.
    assert again == pytest.approx(numbers, rel=5e-3, abs=1e-6)


PAGES = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_file_that_a_document_names_is_there(page: Path) -> None:
    """Names with a folder: from the root, or as in the architecture from the package."""
    named = set(re.findall(r"`(?:python |pytest )?([\w/]+/[\w/]*\w\.\w+)", page.read_text("utf-8")))
    named = {name for name in named if "NAME" not in name}
    lost = [n for n in named if not any((ROOT / at / n).exists() for at in ("", "preview_walk"))]
    assert lost == []


def test_every_picture_of_a_page_is_there_and_small() -> None:
    folder = ROOT / "docs" / "preview"
    pages = sorted(folder.glob("*.md"))
    assert [page.stem for page in pages] == sorted(page.name for page in SCRIPT.PAGES)
    for page in pages:
        text = page.read_text("utf-8")
        pictures = re.findall(r"!\[.+?\]\((\S+?)\)", text)
        assert pictures
        for picture in pictures:
            assert (folder / picture).stat().st_size < 150_000
        for link in re.findall(r"[^!]\[.+?\]\((\S+?)\)", text):
            assert (folder / link).exists(), link


def test_a_plant_of_ones_own_in_the_readme_runs_as_typed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Designed, simulated and compared in ten lines, the imports apart."""
    readme = (ROOT / "README.md").read_text("utf-8")
    blocks = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    (code,) = [code for code in blocks if "pw.preview_gains(" in code]
    lines = [line for line in code.splitlines() if line and not line.startswith("import")]
    assert len(lines) <= 10
    monkeypatch.chdir(tmp_path)
    exec(code, names := {})  # type: ignore[var-annotated]
    assert (tmp_path / "spring.png").stat().st_size > 10_000
    assert [row.split()[0] for row in capsys.readouterr().out.splitlines()[:5]] == [
        "law", "LQR", "LQI", "preview", "MPC",
    ]  # fmt: skip
    comparison = names["comparison"]
    rms = {result.name: (result.run.error**2).mean() ** 0.5 for result in comparison.results}
    assert rms["MPC"] < rms["preview"] < 0.1 * rms["LQI"]
    assert abs(names["run"].error).max() < 0.1
