"""Seeing a walk: films of records, and a live window on a running walk.

Imports `record`, `robots`, `geometry` and MuJoCo's renderers; the window knows a running
`simulation`. Start with `video`, or `window`.
"""
