"""Workers: processes that try one case after the other, and are ended where one does not end."""

from __future__ import annotations

import os
import resource
import tempfile
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path
from time import process_time
from typing import Any

from fuzzing.verdict import FAILED, Verdict

SECONDS = 10.0
"""Processor time that a case may take."""

PATIENCE = 60.0
"""Wall time after which a worker is ended: it may wait for a busy machine, or for ever."""

MEMORY = 1_000_000
"""Kilobytes of memory that a worker may come to take by a case."""

Case = list[str]


def _serve(connection: Connection, kind: str) -> None:
    """Try the cases that come until the connection is closed."""
    os.environ.setdefault("MUJOCO_GL", "egl")
    module = import_module(f"fuzzing.{kind}")
    home = Path.cwd()
    while True:
        try:
            case = connection.recv()
        except EOFError:
            return
        before, peak = process_time(), _peak()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                verdict = module.attempt(case, Path(folder))
            finally:
                os.chdir(home)
        spent, grown = process_time() - before, _peak()
        if spent > SECONDS:
            verdict = Verdict(FAILED, f"it took {spent:.1f} s of processor time", "time")
        if grown > MEMORY and grown - peak > 0.2 * MEMORY:
            verdict = Verdict(FAILED, f"memory grew from {peak} to {grown} kB", "memory")
        connection.send(verdict)


def _peak() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


class Worker:
    """A process that tries cases of one kind; made again after it had to be ended."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._start()

    def _start(self) -> None:
        context = get_context("spawn")
        self.connection, other = context.Pipe()
        self.process: Any = context.Process(target=_serve, args=(other, self.kind), daemon=True)
        self.process.start()
        other.close()

    def send(self, case: Case) -> None:
        """Begin to try a case."""
        self.connection.send(case)

    def verdict(self) -> Verdict:
        """Return what became of the case that was sent."""
        try:
            if self.connection.poll(PATIENCE):
                verdict: Verdict = self.connection.recv()
                return verdict
            verdict = Verdict(FAILED, f"no answer within {PATIENCE:g} s", "hang")
        except (EOFError, ConnectionError):
            self.process.join(5.0)
            code = self.process.exitcode
            verdict = Verdict(FAILED, f"the process died with code {code}", f"death {code}")
        self.close()
        self._start()
        return verdict

    def close(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.join()
        self.connection.close()


def try_all(
    kind: str, cases: Sequence[Case], jobs: int, told: Callable[[int], object]
) -> Iterator[tuple[int, Verdict]]:
    """Yield the number of each case and what became of it, in the order in which they end."""
    workers = [Worker(kind) for _ in range(min(jobs, len(cases)))]
    todo = iter(enumerate(cases))
    busy: dict[Connection, tuple[Worker, int]] = {}

    def give(worker: Worker) -> None:
        following = next(todo, None)
        if following is not None:
            worker.send(following[1])
            busy[worker.connection] = (worker, following[0])

    for worker in workers:
        give(worker)
    try:
        done = 0
        while busy:
            ready = wait(list(busy), PATIENCE)
            for connection in [c for c in busy if c in ready] or list(busy):
                worker, number = busy.pop(connection)
                yield number, worker.verdict()
                done += 1
                told(done)
                give(worker)
    finally:
        for worker in workers:
            worker.close()


def shrink(kind: str, case: Case, found: Verdict) -> Case:
    """Return a case with as few parts as fail in the same place."""
    worker = Worker(kind)
    try:
        smaller = True
        while smaller and len(case) > 1:
            smaller = False
            for number in reversed(range(len(case))):
                fewer = case[:number] + case[number + 1 :]
                worker.send(fewer)
                verdict = worker.verdict()
                if verdict.kind == FAILED and verdict.place == found.place:
                    case, smaller = fewer, True
                    break
    finally:
        worker.close()
    return case
