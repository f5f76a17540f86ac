"""The robot as it is: sensors with noise and delay, motors that lag, a model that is not quite it.

Values with units say what is wrong with a robot; the physics and the readings are made so, and
nobody tells the controller more than a data sheet would. It imports `estimation`, `robots` and
NumPy. Start with `realism`, all of it in one value with its presets; `sensors`, `motors` and
`mismatch` hold its parts, `instruments` what reads, `drives` what turns torques wanted into those
that act, `faults` what fails for a while.
"""
