"""The command `preview-walk`: options in, a walk and its folder of results out.

Imports the public names, and those only when the options are right. Start with `options`, then
`main`.
"""
