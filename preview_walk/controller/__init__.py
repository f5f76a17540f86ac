"""The walker: one control tick from measured state and live plan to joint torques.

It puts `pattern`, `stabilizer` and `tracking` together for a robot, and is the one place where a
plan is replaced; it imports these, `robots`, `footsteps`, `terrain` and `geometry`, and knows no
simulator. Start with `walker`; `feet` holds which foot stands, `balance` what opposes errors and
pushes, `feeling` what soles tell of ground that nobody sees, `airborne` lifts, flights and
landings, `robot_limits` what the legs can do, `motor_limits` what a swing asks of the motors.
"""
