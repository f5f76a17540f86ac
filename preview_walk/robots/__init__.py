"""Robots: from a model file, whatever its make, to one robot in two engines, ready to walk.

`load.load_robot` does it; `inspection.inspect_robot` tells what it found, `listing.list_robots`
shows the catalogue, whose entries are the small files in `models/`. On the way:

    description, source         which file, and what it does not say
    urdf, mjcf, meshes, shapes  reading it, with whatever it links to
    tree, structure, soles      finding base, legs, trunk, front and soles
    motors, inertia, rebuild    adapting it: torque motors, masses that can be, nothing else
    assemble, contact_sensor    MuJoCo's model: soles, floor, motors, force sensors
    pinocchio_model, agreement  Pinocchio's from the same numbers, and the proof that they agree
    posture, statics            the walking posture, and what standing asks of the motors
    build, robot                all of it together, and what comes out
"""
