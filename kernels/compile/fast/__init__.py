"""A compiler for kernels, made of the private parts of the Numba that it knows (`choice`)."""
