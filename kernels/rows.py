"""Rows of index arrays as tuples, which compiled code can unpack; copies of vectors."""

from kernels.jit import jit


@jit
def pair(indices, k):
    """Return row ``k`` of an (n, 2) array."""
    return indices[k, 0], indices[k, 1]


@jit
def triple(indices, k):
    """Return row ``k`` of an (n, 3) array."""
    return indices[k, 0], indices[k, 1], indices[k, 2]


@jit
def copy(source, to):
    """Write ``source`` (n,) into ``to`` (n,)."""
    for i in range(source.size):
        to[i] = source[i]
