"""A study as one HTML page that needs nothing else."""

from __future__ import annotations

import base64
import os
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from preview_walk.files import as_path, whole_file
from preview_walk.studies.journal import read_facts
from preview_walk.studies.pictures import SHARE, heat_map
from preview_walk.studies.results import Results

if TYPE_CHECKING:
    import pandas as pd

MOST_ROWS = 500
"""Rows of failed cases that a page shows."""

_STYLE = """body { font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto;
padding: 0 1rem; color: #1a1a1a; background: #fff }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px }
td, th { padding: .2rem .6rem; border-bottom: 1px solid #ddd; text-align: right }
div { overflow-x: auto }
img { max-width: 100% }
dt { font-weight: 600 }"""


def write_report(results: Results, path: str | os.PathLike[str] | None = None) -> Path:
    """Write a page about a study, one HTML file that needs nothing else; return its path.

    It holds what the study is, survival or margins by its factors, a map over each pair of them (or
    over the first of the pair alone), and the cases that did not succeed.

    Args:
        results: of a study.
        path: of the page; None: report.html in the study's folder.

    Raises:
        OutputError: the file cannot be written.
    """
    target = results.folder / "report.html" if path is None else as_path(path)
    facts = read_facts(results.folder) or {}
    title = escape(str(facts.get("name", "study")))
    names = results.varied
    body = [f"<h1>{title}</h1>", _facts(facts, results)]
    body += [_table(results, by) for by in [(), *((name,) for name in names)]]
    body += _maps(results)
    if len(names) > 1:
        body.append(_table(results, names))
    body.append(_failures(results.table))
    page = (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>'
        f"<style>{_STYLE}</style>{''.join(body)}</html>\n"
    )
    with whole_file(target) as part:
        part.write_text(page, encoding="utf-8")
    return target


def _facts(facts: dict[str, object], results: Results) -> str:
    table = results.table
    shown = {
        "function": facts.get("function"),
        "factors": _in_words(facts.get("factors")),
        "repeats": facts.get("repeats"),
        "seed": facts.get("seed"),
        "margin": facts.get("margin"),
        "cases done": f"{len(results)}, {results.missing} left",
        "processor time": f"{float(table['seconds'].sum()) / 3600.0:.2f} h",
        "versions": "; ".join(sorted(set(table["versions"]))),
    }
    items = [f"<dt>{name}</dt><dd>{escape(str(v))}</dd>" for name, v in shown.items() if v]
    return f"<dl>{''.join(items)}</dl>"


def _in_words(factors: object) -> str:
    """Return factors by name, or how many rows there are."""
    if not isinstance(factors, dict):
        return str(factors or "")
    return "; ".join(f"{name} = {levels}" for name, levels in factors.items())


def _table(results: Results, by: tuple[str, ...]) -> str:
    """Return survival or margins by factors."""
    table = results.margins(by) if "margin" in results.table else results.survival(by)
    title = escape("By " + ", ".join(by) if by else "All cases")
    return f"<h2>{title}</h2><div>{_html(table)}</div>"


def _maps(results: Results) -> list[str]:
    names = results.varied
    value = "margin" if "margin" in results.table else SHARE
    pairs = [(x, y) for k, x in enumerate(names) for y in names[k + 1 :]]
    return [
        f"<h2>{escape(f'{x} and {y}')}</h2>{_picture(heat_map(results, x, y, value))}"
        for x, y in pairs
    ]


def _picture(figure: Figure) -> str:
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=110)
    data = base64.b64encode(stream.getvalue()).decode()
    return f'<img alt="" src="data:image/png;base64,{data}">'


def _failures(table: pd.DataFrame) -> str:
    failed = table[~table["success"].astype(bool)].drop(columns=["versions", "started", "host"])
    if not len(failed):
        return ""
    more = f" (the first {MOST_ROWS})" if len(failed) > MOST_ROWS else ""
    head = f"<h2>Cases that did not succeed: {len(failed)}{more}</h2>"
    return f"{head}<div>{_html(failed.head(MOST_ROWS))}</div>"


def _html(table: pd.DataFrame) -> str:
    html: str = table.to_html(float_format=lambda x: f"{x:.4g}", na_rep="", border=0)
    return html
