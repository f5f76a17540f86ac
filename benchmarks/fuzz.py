"""Odd input of every kind: each case is accepted, or refused in one sentence, within ten seconds.

- command: options with odd values, in odd numbers; the walks of those accepted are cut short.
- api: public calls with odd arguments.
- records: files of records with bytes, arrays and facts changed; what loads is used.
- models: URDF, MJCF and description files with parts dropped, doubled, moved, renamed, spoilt.

The same seed makes the same cases. A traceback, a hang, a dead process, more than ten seconds or a
gigabyte, and more than one sentence are failures; of each place in the code the first is cut down
to the parts that make it fail, and told with the command that runs it again. Exits with 1 if any.

    python benchmarks/fuzz.py --cases 2000 --seed 0 --jobs 2
"""

from __future__ import annotations

import argparse
import json
import os
import shlex
import sys
from collections import Counter
from pathlib import Path
from random import Random

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parent))

from importlib import import_module

from fuzzing.pool import Case, Worker, shrink, try_all
from fuzzing.verdict import ACCEPTED, FAILED, REFUSED, Verdict

KINDS = ("command", "api", "records", "models")


def draw(kind: str, count: int, seed: int) -> list[Case]:
    """Return the cases of a kind; case i of a seed is the same however many there are."""
    module = import_module(f"fuzzing.{kind}")
    return [module.draw(Random(f"{seed} {kind} {i}")) for i in range(count)]


def fuzz(
    kind: str, count: int, seed: int, jobs: int
) -> tuple[Counter[str], list[tuple[Case, Verdict]]]:
    """Return how many cases were accepted, refused and failed, and a small one for each failure."""
    cases = draw(kind, count, seed)
    counts: Counter[str] = Counter()
    first: dict[str, tuple[int, Verdict]] = {}

    def tell(done: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{kind}: {done} of {count}", end="", file=sys.stderr)

    for number, verdict in try_all(kind, cases, jobs, tell):
        counts[verdict.kind] += 1
        known = first.get(verdict.place)
        if verdict.kind == FAILED and (known is None or number < known[0]):
            first[verdict.place] = (number, verdict)
    found = sorted(first.values(), key=lambda entry: entry[0])
    return counts, [(shrink(kind, cases[number], verdict), verdict) for number, verdict in found]


def run_again(kind: str, case: Case) -> int:
    """Try one case and tell what becomes of it."""
    worker = Worker(kind)
    worker.send(case)
    verdict = worker.verdict()
    worker.close()
    print(f"{verdict.kind}: {verdict.detail} {verdict.place}".rstrip())
    return int(verdict.kind == FAILED)


def main() -> int:
    """Fuzz, print the table and the failures; return 1 if there are any."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=2000, help="of each kind (default 2000)")
    parser.add_argument("--seed", type=int, default=0, help="of the cases (default 0)")
    parser.add_argument("--what", choices=KINDS, action="append", help="kind; may be repeated")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--again", metavar="PARTS", help="try this one case of --what, as printed")
    given = parser.parse_args()
    kinds = given.what or list(KINDS)
    if given.again is not None:
        return run_again(kinds[0], json.loads(given.again))
    print(f"{'':10}{'cases':>8}{'accepted':>10}{'refused':>10}{'failed':>8}", flush=True)
    failures = 0
    for kind in kinds:
        counts, found = fuzz(kind, given.cases, given.seed, given.jobs)
        row = (counts[ACCEPTED], counts[REFUSED], counts[FAILED])
        print(f"{kind:10}{given.cases:8}{row[0]:10}{row[1]:10}{row[2]:8}", flush=True)
        for case, verdict in found:
            failures += 1
            again = shlex.quote(json.dumps(case))
            print(f"  {verdict.detail} [{verdict.place}]")
            print(f"    python benchmarks/fuzz.py --what {kind} --again {again}", flush=True)
    return int(failures > 0)


if __name__ == "__main__":
    raise SystemExit(main())
