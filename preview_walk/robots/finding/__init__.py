"""Finding what a model means: base, legs, trunk, front and soles.

Imports `robots.reading`. Start with `structure`, then `soles`.
"""
