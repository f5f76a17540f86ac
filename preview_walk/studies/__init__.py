"""Campaigns: a function over many cases, on all cores or a cluster, resumable, with nothing lost.

Imports everything below it; joblib, pandas and Dask only when a study runs. Start with `study`
(what is to be done), then `engine` (how it is done) and `results` (what came out).
"""
