"""The pages of `docs/preview/`: runs their examples, writes code, output and pictures there.

python docs/preview_pages.py

What stands between `<!-- code -->` and `<!-- /code -->` is the example itself, between
`<!-- output -->` and `<!-- /output -->` what it printed; the rest of a page is written by hand.
"""

import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

HERE = Path(__file__).parent
COLOURS = 256  # of a palette: with fewer, thin lines change their colour


@dataclass(frozen=True)
class Page:
    """A page and its example.

    Attributes:
        name: of the page.
        example: that it shows.
        unit: of the error in the table of horizons; empty where the example draws it itself.
    """

    name: str
    example: str
    unit: str = ""


PAGES = (
    Page("cart-table", "preview_horizon"),
    Page("walking-laws", "walking_laws"),
    Page("active-suspension", "active_suspension"),
    Page("servo", "servo", "rad"),
    Page("crane", "crane", "m"),
)


def code_of(page: Page) -> str:
    """Return the example of a page."""
    return (HERE.parent / "examples" / f"{page.example}.py").read_text("utf-8").strip()


def output_of(page: Page, picture: Path) -> str:
    """Run the example, which draws `picture`, and return what it printed."""
    script = HERE.parent / "examples" / f"{page.example}.py"
    line = [sys.executable, str(script), "--out", str(picture)]
    done = subprocess.run(line, capture_output=True, text=True, check=True)
    kept = [text.rstrip() for text in done.stdout.splitlines() if not text.startswith("wrote ")]
    return "\n".join(kept)


def horizons(output: str) -> np.ndarray:
    """Return the rows (preview in s, error) of the table under "preview (s)" that was printed."""
    table = output.split("preview (s)")[1].splitlines()[1:]
    rows = [re.fullmatch(r"\s*([\d.]+)\s+([\d.]+)", line) for line in table]
    return np.array([[float(number) for number in row.groups()] for row in rows if row])


def draw_horizons(page: Page, output: str, path: Path) -> None:
    """Draw the largest error against the preview horizon."""
    seconds, errors = horizons(output).T
    figure = Figure(figsize=(7.0, 3.0), layout="constrained")
    axes = figure.subplots()
    axes.semilogy(seconds, errors, color="#0072B2", marker="o")
    axes.set(xlabel="preview [s]", ylabel=f"largest error [{page.unit}]")
    axes.grid(which="both", color="0.92")
    figure.savefig(path, dpi=110)


def filled(text: str, part: str, language: str, content: str) -> str:
    """Return a page's text with this content between the marks of a part."""
    block = f"<!-- {part} -->\n```{language}\n{content}\n```\n<!-- /{part} -->"
    pattern = f"<!-- {part} -->.*?<!-- /{part} -->"
    return re.sub(pattern, lambda _: block, text, flags=re.DOTALL)


def small(path: Path, target: Path) -> None:
    """Write a picture with a palette: a quarter of the size, and no difference to see."""
    with Image.open(path) as picture:
        width = min(picture.width, 1100)
        size = (width, round(picture.height * width / picture.width))
        picture.convert("RGB").resize(size).quantize(COLOURS).save(target, optimize=True)
    print(f"wrote {target} ({target.stat().st_size / 1024:.0f} KB)")


def main() -> None:
    """Run every example and write its page."""
    with tempfile.TemporaryDirectory() as folder:
        for page in PAGES:
            picture = Path(folder) / f"{page.name}.png"
            output = output_of(page, picture)
            small(picture, HERE / "preview" / picture.name)
            if page.unit:
                curve = Path(folder) / f"{page.name}-horizon.png"
                draw_horizons(page, output, curve)
                small(curve, HERE / "preview" / curve.name)
            target = HERE / "preview" / f"{page.name}.md"
            text = filled(target.read_text("utf-8"), "code", "python", code_of(page))
            target.write_text(filled(text, "output", "text", output), "utf-8")
            print(f"wrote {target}")


if __name__ == "__main__":
    main()
