"""Plain loops over arrays, which compile faster than the array functions of Numba."""

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning


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


@jit
def add(source, to):
    """Add ``source`` (n,) to ``to`` (n,)."""
    for i in range(source.size):
        to[i] += source[i]


@jit
def zero(vector):
    """Fill ``vector`` (n,) with zeros."""
    for i in range(vector.size):
        vector[i] = 0.0


@jit
def zero_rows(matrix):
    """Fill ``matrix`` (m, n) with zeros."""
    for k in range(matrix.shape[0]):
        for i in range(matrix.shape[1]):
            matrix[k, i] = 0.0


@jit_exact
def greatest(vector):
    """Return the largest entry of ``vector`` (n,), or 0 if all are negative or there is none."""
    most = 0.0
    for i in range(vector.size):
        most = max(most, vector[i])
    return most


@jit
def dot(a, b):
    """Return the sum of the products of ``a`` (n,) and ``b`` (n,), added in any order."""
    value = 0.0
    for i in range(a.size):
        value += a[i] * b[i]
    return value


@jit_exact
def total(vector):
    """Return the sum of ``vector`` (n,)."""
    value = 0.0
    for i in range(vector.size):
        value += vector[i]
    return value


@jit_exact
def first_at_least(ascending, value, low, high):
    """Return the first of the indices ``low`` .. ``high`` - 1 whose entry of ``ascending`` (n,) is
    at least ``value``, ``high`` if there is none.
    """
    while low < high:
        middle = (low + high) // 2
        if ascending[middle] < value:
            low = middle + 1
        else:
            high = middle
    return low


@jit_exact
def piece(bounds, value):
    """Return the index i with bounds[i] <= ``value`` < bounds[i + 1], clipped to the first or last
    piece. bounds (n + 1,): ascending.
    """
    low, high = 0, bounds.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if bounds[middle] <= value:
            low = middle
        else:
            high = middle
    return low


@jit_owning
def grouped(group, n):
    """Return (start (n + 1,), order): the members of group g are order[start[g]:start[g + 1]].

    group: group 0 .. n - 1 of each member; within a group, members keep their order.
    """
    start, order = np.zeros(n + 1, np.int64), np.empty(group.size, np.int64)
    for g in group:
        start[g + 1] += 1
    for g in range(n):
        start[g + 1] += start[g]
    free = start.copy()
    for k in range(group.size):
        order[free[group[k]]] = k
        free[group[k]] += 1
    return start, order
