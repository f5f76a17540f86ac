"""Where cases run: loky, joblib's pool of processes on this machine, or the workers of Dask."""

from __future__ import annotations

import os
import signal
import threading
from concurrent.futures import Executor, Future
from time import sleep
from typing import Any, Protocol

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.extras import require
from preview_walk.studies.case import Case
from preview_walk.studies.work import Row, Work, run_case

_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")

_CONNECT = 10.0
"""Seconds within which a scheduler must answer."""


class Pool(Protocol):
    """What the engine needs of a pool of workers."""

    @property
    def at_once(self) -> int:
        """How many cases are handed over at a time: enough to keep every worker busy."""

    def submit(self, work: Work, case: Case) -> Future[Row]:
        """Hand a case over."""

    def broken_by(self, error: BaseException) -> bool:
        """Return whether an error says that the pool is lost with all that it had."""

    def renew(self) -> None:
        """Make the pool anew."""

    def close(self) -> None:
        """Let the workers go; what they are at is given up."""


class LocalPool:
    """Processes on this machine, each with one thread for linear algebra."""

    def __init__(self, jobs: int | None) -> None:
        """Start that many processes when there is work for them; None: one a core."""
        require("a study", "studies", "joblib")
        from joblib import cpu_count

        self.jobs: int = cpu_count() if jobs is None else jobs
        self._executor = self._new()

    def _new(self) -> Any:
        from joblib.externals.loky import ProcessPoolExecutor

        return ProcessPoolExecutor(
            self.jobs, initializer=_obey_the_parent, initargs=(os.getpid(),), env=_ONE_THREAD
        )

    @property
    def at_once(self) -> int:
        """Two for each worker: one that it does, one that waits."""
        return 2 * self.jobs

    def submit(self, work: Work, case: Case) -> Future[Row]:
        """Hand a case over."""
        future: Future[Row] = self._executor.submit(run_case, work, case)
        return future

    def broken_by(self, error: BaseException) -> bool:
        """Return whether a worker ended, which ends loky's pool.

        Raises:
            InvalidInput: it ended because it cannot read what it is to do, as no other could.
        """
        from concurrent.futures.process import BrokenProcessPool

        if not isinstance(error, BrokenProcessPool):
            return False
        if error.__cause__ is not None:  # what a worker raised before it had a case to blame
            why = str(error.__cause__).strip().rstrip('"').strip().splitlines()[-1]
            why = why.split(" on <module")[0]
            raise InvalidInput(
                f"the workers cannot read the study's function: {why}; what it calls must be "
                "importable, or defined beside it without a cache or another wrapper.",
                argument="function",
            )
        return True

    def renew(self) -> None:
        """Start other processes."""
        self.close()
        self._executor = self._new()

    def close(self) -> None:
        """End the processes."""
        self._executor.shutdown(wait=True, kill_workers=True)


class ClusterPool:
    """The workers of a Dask cluster, which should have one thread each.

    The scheduler gives the cases of a worker that ended to others, and blames each that was there
    when the fourth of them ended, whichever it was that ended them.
    """

    def __init__(self, scheduler: str) -> None:
        """Connect to a scheduler, as "tcp://host:8786".

        Raises:
            InvalidInput: none answers there, or Dask is not installed.
        """
        require("a study on a cluster", "cluster", "distributed")
        import distributed

        client: Any = distributed.Client
        try:
            self._client = client(scheduler, timeout=_CONNECT, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            raise InvalidInput(
                f"scheduler must be the address of a Dask scheduler that answers, as "
                f"tcp://host:8786, got {shown(scheduler)}.",
                argument="scheduler",
            ) from error
        self._executor: Executor = self._client.get_executor(pure=False)

    @property
    def at_once(self) -> int:
        """Two for each thread of the workers that there are now, which may become more."""
        threads: dict[str, int] = self._client.nthreads()
        return max(2, 2 * sum(threads.values()))

    def submit(self, work: Work, case: Case) -> Future[Row]:
        """Hand a case over."""
        return self._executor.submit(run_case, work, case)

    def broken_by(self, error: BaseException) -> bool:
        """Return whether a case is blamed for its workers' ends; alone it shows if rightly."""
        from distributed.scheduler import KilledWorker

        return isinstance(error, KilledWorker)

    def renew(self) -> None:
        """Do nothing: the scheduler outlives its workers, and has others started."""

    def close(self) -> None:
        """Let go of the cluster, and of the cases that it has not done."""
        self._client.close()


def _obey_the_parent(parent: int) -> None:
    """Leave Ctrl-C to the parent, which ends its workers; end where the parent was killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        sleep(1.0)
    os._exit(1)
