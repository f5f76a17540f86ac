"""Preview control of any linear plant, and of the cart-table in particular.

Imports numpy, scipy and control; it knows no footsteps and no robot. Start with `gains` (the law
and its Riccati equation), then `controller` (one tick of it for walking).
"""
