"""What a campaign costs beside its cases: workers against one, walks against their plain loop.

    python benchmarks/campaigns.py

Prints the throughput of two workers over that of one, the share of a walk that handing it out and
writing its row takes, and for 10,000 cases of a millisecond the time a case and the parent's
memory.
"""

from __future__ import annotations

import argparse
import resource
import tempfile
from pathlib import Path
from time import perf_counter, sleep
from typing import Any

import preview_walk as pw


def walk(index: int) -> pw.Record:
    """Return the record of two seconds of walking."""
    return pw.walk_case("talos", (0.3, 0.0, 0.0), 1.0, seed=index)


def wait(index: int) -> dict[str, Any]:
    """Take a millisecond."""
    sleep(0.001)
    return {"index_squared": index * index}


def timed(study: pw.Study, jobs: int) -> tuple[float, pw.Results]:
    """Return the time that a study takes, s, and its results."""
    with tempfile.TemporaryDirectory() as folder:
        began = perf_counter()
        results = study.run(Path(folder), jobs=jobs, progress=False)
        return perf_counter() - began, results


def memory() -> float:
    """Return the largest memory of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--walks", type=int, default=200, help="walks of each run (default 200)")
    parser.add_argument("--cases", type=int, default=10_000, help="of a millisecond")
    given = parser.parse_args()
    walks = pw.Study({"index": list(range(given.walks))}, walk, name="walks")
    one, results = timed(walks, 1)
    two, _ = timed(walks, 2)
    inside = float(results.table["seconds"].sum())
    print(f"{given.walks} walks: one worker {one:.1f} s, two {two:.1f} s: {one / two:.2f} times")
    print(
        f"  one worker's start, handing out, rows: {100.0 * (one / inside - 1.0):.1f} % of a walk"
    )
    before = memory()
    small = pw.Study({"index": list(range(given.cases))}, wait, name="small")
    spent, results = timed(small, 2)
    each = 1e3 * (spent / given.cases - 0.5e-3)
    print(f"{given.cases} cases of 1 ms, two workers: {each:.2f} ms a case more than its share")
    print(f"  memory of the parent: {before:.0f} MB before, {memory():.0f} MB at most")


if __name__ == "__main__":
    main()
