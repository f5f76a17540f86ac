"""Preview control of any linear plant, and of the cart-table in particular.

Imports numpy, scipy, platformdirs and, only where it is used, control, qpsolvers and matplotlib;
it knows no footsteps and no robot. Start with `gains` (the law and its Riccati equation, from a
plant read by `plant`), then `response` (a whole run), `servo` (one sample of it) and `controller`
(the same for walking).
"""
