"""Building the robot that walks: motors, floor, sensors, the same model in two engines, posture.

Imports `robots.reading` and `robots.finding`. Start with `build`.
"""
