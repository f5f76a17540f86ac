"""Robots: from a model file, whatever its make, to one robot in two engines, ready to walk.

Imports geometry, and of `pattern` how far a leg may stretch; MuJoCo and Pinocchio. Start with
`load.load_robot`; `inspection.inspect_robot` tells what it found, `listing.list_robots` shows the
catalogue, whose entries are the small files in `models/`. On the way:

    reading/     which file, what it does not say, and whatever it links to
    finding/     base, legs, trunk, front, soles
    building/    motors, soles and sensors in both engines, the proof that they agree, the posture
    robot        what comes out
    standing     how it stands elsewhere, and with its CoM at another height
    state        the one converter between the engines' conventions
"""
