"""The walker: one control tick from measured state and live plan to joint torques.

It puts `pattern`, `stabilizer` and `tracking` together for a robot, and is the one place where a
plan is replaced; it imports these and `robots`, and knows no simulator. Start with `walker`.
"""
