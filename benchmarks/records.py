"""What an hour of walking takes: memory and file of a record, at a rate of rows.

The rows of a short walk of TALOS go through the recorder again and again, for as long as is asked,
as they would come from a walk.

    python benchmarks/records.py --hz 50 --seconds 3600
"""

from __future__ import annotations

import argparse
import resource
import tempfile
from pathlib import Path
from time import perf_counter

import preview_walk as pw
from preview_walk.record.fields import FIELDS
from preview_walk.record.recorder import Recorder

WALKED = 20.0
"""Seconds that are walked."""


def main() -> None:
    """Walk, record, save and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hz", type=float, default=50.0, help="rows per second (default 50)")
    parser.add_argument("--seconds", type=float, default=3600.0, help="default: an hour")
    given = parser.parse_args()
    walk = pw.Walk.standing(pw.load_robot("talos"), record_hz=given.hz)
    walk.command(0.4, 0.0, 0.1)
    short = walk.run(until=WALKED).record()
    before = _memory()
    rows = [{name: getattr(short, name)[i] for name in FIELDS} for i in range(len(short))]
    with tempfile.TemporaryDirectory() as folder:
        sizes = {"nq": short.q.shape[1], "nv": short.v.shape[1], "nu": short.tau.shape[1]}
        recorder = Recorder(short.run, sizes, blocks=Path(folder) / "blocks")
        count = round(given.seconds * given.hz)
        began = perf_counter()
        for i in range(count):
            recorder.write(**{**rows[i % len(rows)], "time": i / given.hz})
        spent = perf_counter() - began
        record = recorder.finish()
        path = record.save(Path(folder) / "record.npz")
        record.summary()
        print(
            f"{given.seconds:g} s at {given.hz:g} rows a second: {len(record)} rows, "
            f"{1e6 * spent / count:.0f} us each with their blocks; file "
            f"{path.stat().st_size / 2**20:.0f} MiB; memory {before:.0f} MiB before, at most "
            f"{_memory():.0f} MiB with record, file and summary"
        )


def _memory() -> float:
    """Return the most memory that this process has had, MiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


if __name__ == "__main__":
    main()
