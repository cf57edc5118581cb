"""The same examples on every run, few enough for the default tests."""

from hypothesis import settings

settings.register_profile("repeatable", derandomize=True, max_examples=40, deadline=None)
settings.load_profile("repeatable")
