"""The QP of a tick: its terms, its exact condensing, its solvers, and what stands in for it.

Imports `robots` and the rest of `tracking`. Start with `problem`, then `solvers`.
"""
