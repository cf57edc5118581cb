"""What all tests share."""

from grasptypes.runtime import pin_runtime

# As in jobs and commands: Numba then compiles for them and for the tests once, and the threads of
# test processes that run side by side do not wait for each other.
pin_runtime()
