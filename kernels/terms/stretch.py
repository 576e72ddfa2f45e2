"""Stretching: E_s = sum A l0 W(e), with W the energy density of a material law.

e is the strain of the centre line, which is an arc over its chord of length l:

    e = l / l0 - 1 + c_s (a_1^2 + a_2^2) + c_m a_1 a_2

c_s = 1/15 and c_m = -1/30 for a cubic without shear, whose arc is longer than its chord by l0 times
the mean of half the square of its slope against the chord (with shear: sweep/scene/beams.py). Both
are zero where e is the strain of the chord: in classical elements and solid joints. W of a law with
memory is its incremental potential (`laws.law`).
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact


class Stretch(NamedTuple):
    """l0 (m,) rest length in m, area (m,) in m^2, arc (2, m): c_s and c_m.

    geometric: the Hessian has its part N n n / l (`elements`). Without it the Hessian is not exact:
    the iteration is a quasi-Newton method, and stability is checked with this matrix.
    """

    l0: np.ndarray
    area: np.ndarray
    arc: np.ndarray
    geometric: bool


@jit
def strain(stretch, shape, k):
    """Return the strain e of element ``k`` and its derivatives in a_1 and a_2."""
    one, two = shape.turn[0, k], shape.turn[1, k]
    same, mixed = stretch.arc[0, k], stretch.arc[1, k]
    along = shape.length[k] / stretch.l0[k] - 1.0
    arc = same * (one * one + two * two) + mixed * one * two
    return along + arc, 2.0 * same * one + mixed * two, 2.0 * same * two + mixed * one


@jit
def push(stretch, resultants, k, volume, slopes, stress, tangent, projected):
    """Write the derivatives of ``volume`` x W(e) of element ``k``: W' = ``stress``, W'' =
    ``tangent``; ``slopes``: of e in a_1 and a_2.
    """
    force, rigidity = resultants.force, resultants.rigidity
    one, two = slopes
    by_l0 = 1.0 / stretch.l0[k]
    force[0, k] = volume * stress * by_l0
    force[1, k] = volume * stress * one
    force[2, k] = volume * stress * two
    same, mixed = 2.0 * stretch.arc[0, k], stretch.arc[1, k]
    if projected:
        stress, tangent = max(stress, 0.0), max(tangent, 0.0)
        same, mixed = _convex(same, mixed)
    same, mixed = stress * same, stress * mixed
    rigidity[0, k] = volume * tangent * by_l0 * by_l0
    rigidity[1, k] = volume * tangent * by_l0 * one
    rigidity[2, k] = volume * tangent * by_l0 * two
    rigidity[3, k] = volume * (tangent * one * one + same)
    rigidity[4, k] = volume * (tangent * one * two + mixed)
    rigidity[5, k] = volume * (tangent * two * two + same)


@jit
def _convex(same, mixed):
    """Return the second derivatives [[same, mixed], [mixed, same]] of e with negative eigenvalues
    set to zero.

    With shear, a short thick element shortens when both ends turn the same way.
    """
    if abs(mixed) <= same:
        return same, mixed
    alike, opposed = max(same + mixed, 0.0), max(same - mixed, 0.0)
    return 0.5 * (alike + opposed), 0.5 * (alike - opposed)


@jit
def evaluate(stretch, law, memory, shape, resultants, projected):
    """Return E_s in J; write its derivatives into ``resultants``.

    Elements are the material points of the ``law``. projected: stress, tangent and second
    derivatives of e are clipped at zero, which makes every element positive semi-definite.
    """
    if law.is_elastic:
        return _evaluate(stretch, law.elastic(), (), shape, resultants, projected)
    return _evaluate(stretch, law, memory, shape, resultants, projected)


@jit
def _evaluate(stretch, law, memory, shape, resultants, projected):
    """Return E_s as `evaluate` does. Laws with and without memory are compiled separately."""
    total = 0.0
    for k in range(stretch.l0.size):
        e, one, two = strain(stretch, shape, k)
        density, stress, tangent = law.respond(e, memory, k)
        volume = stretch.area[k] * stretch.l0[k]
        total += volume * density
        push(stretch, resultants, k, volume, (one, two), stress, tangent, projected)
    return total


@jit_exact
def begin(stretch, law, memory):
    """Set the data of all material points for the present step."""
    for k in range(stretch.l0.size):
        law.begin(memory, k)


@jit_exact
def commit(stretch, law, memory, shape):
    """Commit the strains of ``shape`` to the law.

    Return (released, dissipated) in J: E_s less the stored energy, and the dissipation of the step.
    """
    released, dissipated = 0.0, 0.0
    for k in range(stretch.l0.size):
        e, volume = strain(stretch, shape, k)[0], stretch.area[k] * stretch.l0[k]
        release, dissipation = law.commit(e, memory, k)
        released += volume * release
        dissipated += volume * dissipation
    return released, dissipated
