"""Strain measures of a quad that is no rectangle: from natural coordinates to orthonormal axes.

s and z follow the sides of the quad. With the metric A of the rest shape in (s, z), the axes

    t1 = a x,s,   t2 = b x,s + c x,z
    a = A11^(-1/2),   c = (A11 / det A)^(1/2),   b = -c A12 / A11

are orthonormal there. A tensor m, as (m11, m22, m12), has in these axes the components P m,

        | a^2  0    0    |
    P = | b^2  c^2  2 b c |
        | a b  0    a c  |

The slopes of an energy in m are its slopes in P m times P; m12 counts once, as in `laws.sheet`.
"""

import math

from kernels.compile.jit import jit, jit_exact


@jit_exact
def orthonormal(a11, a22, a12):
    """Return a, b, c for the metric of the rest shape, and the area that belongs to a unit of s and
    z.
    """
    det = a11 * a22 - a12 * a12
    c = math.sqrt(a11 / det)
    return 1.0 / math.sqrt(a11), -c * a12 / a11, c, math.sqrt(det)


@jit
def turned(a, b, c, one, two, both):
    """Return P (one, two, both)."""
    return a * a * one, b * b * one + c * c * two + 2.0 * b * c * both, a * (b * one + c * both)


@jit
def turn(axes, m):
    """Transform the measures ``m`` (9,), three tensors, to the ``axes`` (3,): a, b, c."""
    a, b, c = axes[0], axes[1], axes[2]
    for k in range(0, 9, 3):
        m[k], m[k + 1], m[k + 2] = turned(a, b, c, m[k], m[k + 1], m[k + 2])


@jit
def pulled(a, b, c, one, two, both):
    """Return (one, two, both) P."""
    return a * a * one + b * (b * two + a * both), c * c * two, c * (2.0 * b * two + a * both)


@jit
def pull_back(axes, slope):
    """Transform the slopes (9,) of an energy from measures in the ``axes`` to measures in (s,
    z).
    """
    for k in range(0, 9, 3):
        slope[k], slope[k + 1], slope[k + 2] = pulled(
            axes[0], axes[1], axes[2], slope[k], slope[k + 1], slope[k + 2]
        )


@jit
def pull_back_second(axes, second):
    """Transform the second derivatives (9, 9) in the same way."""
    a, b, c = axes[0], axes[1], axes[2]
    for i in range(9):
        for k in range(0, 9, 3):
            second[i, k], second[i, k + 1], second[i, k + 2] = pulled(
                a, b, c, second[i, k], second[i, k + 1], second[i, k + 2]
            )
    for i in range(9):
        for k in range(0, 9, 3):
            second[k, i], second[k + 1, i], second[k + 2, i] = pulled(
                a, b, c, second[k, i], second[k + 1, i], second[k + 2, i]
            )
