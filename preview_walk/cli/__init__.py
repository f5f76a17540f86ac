"""The command `preview-walk`: options in, a walk and its folder of results out.

Imports everything below it, and that only when the options are right. Start with `option_table`
(what can be asked for), then `main` and `run`.
"""
