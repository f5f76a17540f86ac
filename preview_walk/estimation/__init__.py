"""Where the robot is, from what its sensors say: base pose and velocity, contact forces.

It imports `robots`, `geometry`, `terrain` and NumPy, and knows no simulator. Start with
`measurement`, what one tick's sensors read; `base_filter` is the contact-aided Kalman filter,
`signals` refuses readings that cannot be, `joints` and `sole_forces` make good for
sensors that fail, `estimator` puts them together for a robot.
"""
