"""A walk in the browser: live, from a record, or as one HTML file.

Imports what `viewer` does; viser and mjviser, the extra `web`, are imported when a page is made.
Start with `show`. On the way:

    server     the page itself: host and port
    stage      what is shown: a MuJoCo model with its looks
    nodes      its bodies and its ground as nodes of the page's scene
    traces     CoM, ZMP and DCM of the last seconds, planned and measured
    plots      the same as plots, and as marks in the scene
    picture    all that the scene shows of one moment
    controls   sliders and buttons of a live walk
    live       the loop of a live walk
    replay     the loop of a record
    pace       so many pictures a second
    export     a record as one HTML file
"""
