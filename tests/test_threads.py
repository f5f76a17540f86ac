"""One thread for linear algebra, and what it was before given back."""

from __future__ import annotations

import scipy.linalg  # noqa: F401 - its BLAS must be loaded to be limited
from threadpoolctl import threadpool_info

from preview_walk.threads import one_thread


def threads() -> list[int]:
    """Return the number of threads of each BLAS loaded."""
    return [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]


def test_blas_has_one_thread_inside_and_its_own_number_again_after() -> None:
    before = threads()
    assert before
    for _ in range(2):
        with one_thread():
            assert set(threads()) == {1}
        assert threads() == before
