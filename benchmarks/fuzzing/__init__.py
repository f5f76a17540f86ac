"""Fuzzing: odd command lines, calls, records and model files, and what becomes of them.

Each kind is a module with `draw`, which makes a case out of parts that can be left out one by one,
and `attempt`, which tries it. Imports `preview_walk` and the tables of the tests. Start with
`verdict`, then `pool`.
"""
