"""The command `preview-walk`: options in, a walk and its folder of results out.

Imports the public names, `analysis` and `viewer`, and those only when the options are right. Start
with `option_table` (what can be asked for), then `main` and `run`.
"""
