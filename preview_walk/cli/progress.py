"""The bar that shows how far a walk or its film is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

FORM = "{desc}: {percentage:3.0f}%|{bar}| {n:.1f}/{total:.1f} s [{elapsed}<{remaining}]"


@contextmanager
def progress_bar(
    what: str = "walking", *, shown: bool = True
) -> Iterator[Callable[[float, float], None]]:
    """Show a bar on stderr; gives the function to call with the simulated time and its end, s.

    Args:
        what: is done.
        shown: whether there is a bar at all.
    """
    from tqdm import tqdm

    # None before the walk begins: bad input is to get its sentence and nothing else.
    bars: list[Any] = []

    def progress(time: float, end: float) -> None:
        if not shown:
            return
        if not bars:
            interval = 0.1 if sys.stderr.isatty() else 5.0
            bars.append(tqdm(desc=what, total=end, bar_format=FORM, mininterval=interval))
        bars[0].total = end
        bars[0].update(time - bars[0].n)

    try:
        yield progress
    finally:
        for bar in bars:
            bar.close()
