"""One thread for linear algebra: a tick's matrices are too small to be shared out.

OpenBLAS takes all cores for them and waits for each other's threads in a busy loop: on a machine
that has anything else to do, a tick then takes ten milliseconds instead of a fifth of one. With one
thread the result does not depend on the number of cores, either.
"""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import lru_cache
from typing import Any

from threadpoolctl import ThreadpoolController


def one_thread() -> AbstractContextManager[Any]:
    """Return a context in which BLAS uses one thread; a few microseconds to enter and leave."""
    limits: AbstractContextManager[Any] = _controller().limit(limits=1, user_api="blas")
    return limits


@lru_cache(maxsize=1)
def _controller() -> ThreadpoolController:
    # Made late: it knows the libraries that are loaded now.
    return ThreadpoolController()
