"""Finding what a model means: base, legs, trunk, front and soles.

Imports geometry only, nothing else of `robots` but its bounds. Start with `structure`, then
`soles`; `tree` holds the questions that both ask of a compiled model.
"""
