"""Seeing a walk: films of records, a live window on a running walk, and pages in a browser.

Imports `record`, `robots`, `geometry` and MuJoCo's renderers; the window and the pages know a
running `simulation`; pages also take what they need of its `controller`, `footsteps` and `terrain`,
and colours of `analysis`. Start with `video`, `window`, or `web/show`.
"""
