"""Fixed-point iteration with Anderson's extrapolation over several iterations.

With y the argument, x its image, r = x - y, and the changes dy_j, dr_j of the last iterations, the
next argument is

    y' = y + r - sum_j c_j (dy_j + dr_j),   c = argmin |r - sum_j c_j dr_j|

(Anderson 1965, J. ACM 12, 547; Walker and Ni 2011, SIAM J. Numer. Anal. 49, 1715): the step of a
secant method in the space of these changes. Aitken's extrapolation is the case of one change.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact, jit_owning

DEPTH = 5  # changes that are kept
DEPENDENT = 1e-2  # a change is left out if less than this share of it is new
LARGEST_CHANGE = 0.5  # of `Coordinates.leap`: no extrapolation if it would shift y by more


class Past(NamedTuple):
    """y, r (n,): argument and residual of the last iteration, lengths. dy, dr (DEPTH, n): changes
    of both; iteration k is in row k modulo DEPTH. basis, shift (DEPTH, n), step (n,): scratch.
    """

    y: np.ndarray
    r: np.ndarray
    dy: np.ndarray
    dr: np.ndarray
    basis: np.ndarray
    shift: np.ndarray
    step: np.ndarray


@jit_owning
def no_past(n):
    """Return an empty `Past` for ``n`` coordinates."""
    one, two = np.zeros((3, n)), np.zeros((4, DEPTH, n))
    return Past(one[0], one[1], two[0], two[1], two[2], two[3], one[2])


@jit_exact
def _record(x, y, coordinates, loops, past):
    """Write the argument ``y`` and its residual, and the changes of both."""
    row = loops % DEPTH
    for i in range(x.size):
        r, length = (x[i] - y[i]) * coordinates.scale[i], y[i] * coordinates.scale[i]
        past.dr[row, i], past.dy[row, i] = r - past.r[i], length - past.y[i]
        past.r[i], past.y[i] = r, length


@jit_exact
def _subtract(factor, other, vector):
    """Subtract ``factor`` times ``other`` from ``vector``."""
    for i in range(vector.size):
        vector[i] -= factor * other[i]


@jit_exact
def _orthonormalise(loops, past):
    """Fill ``basis`` with orthonormal combinations of dr, the newest first, and ``shift`` with the
    same combinations of dy + dr; return their number.
    """
    count = 0
    for age in range(min(loops, DEPTH)):
        row = (loops - age) % DEPTH
        basis, shift = past.basis[count], past.shift[count]
        copy(past.dr[row], basis)
        copy(past.dy[row], shift)
        _subtract(-1.0, basis, shift)
        size = dot(basis, basis)
        for k in range(count):
            share = dot(past.basis[k], basis)
            _subtract(share, past.basis[k], basis)
            _subtract(share, past.shift[k], shift)
        left = dot(basis, basis)
        if left > DEPENDENT * DEPENDENT * size:
            factor = 1.0 / np.sqrt(left)
            for i in range(basis.size):
                basis[i], shift[i] = factor * basis[i], factor * shift[i]
            count += 1
    return count


@jit_exact
def extrapolate(x, y, coordinates, loops, past):
    """Replace the argument ``y`` (n,) by y', given its image ``x`` (n,).

    loops: number of iterations before.
    """
    _record(x, y, coordinates, loops, past)
    zero(past.step)
    for k in range(_orthonormalise(loops, past)):
        _subtract(-dot(past.basis[k], past.r), past.shift[k], past.step)
    largest = 0.0
    for move in past.step:
        largest = max(largest, abs(move))
    extrapolated = largest <= LARGEST_CHANGE * coordinates.leap
    for i in range(x.size):
        y[i] = x[i] - (past.step[i] / coordinates.scale[i] if extrapolated else 0.0)
