"""Cases and states that are timed, and how: clocks, counts, repeated kernels."""
