"""A walk in the browser: live, from a record, or as one HTML file.

Imports of `viewer`'s neighbours `record`, `robots` and `simulation`; viser and mjviser, the extra
`web`, are imported when a page is made. Start with `show`. On the way:

    stage      what is shown: a MuJoCo model with its looks
    nodes      its bodies and its ground as nodes of the page's scene
    server     the page itself: host, port, camera
    traces     CoM, ZMP and DCM of the last seconds, planned and measured
    plots      the same as plots
    controls   sliders and buttons of a live walk
    live       the loop of a live walk
    replay     the loop of a record
    export     a record as one HTML file
"""
