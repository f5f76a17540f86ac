"""Settings shared by all tests."""

from hypothesis import settings

# Same input, same output: property tests draw the same examples in every run.
settings.register_profile("deterministic", derandomize=True, deadline=None)
settings.load_profile("deterministic")
