"""Stretching of straight elements: E_s = sum A l0 W(e), nominal strain e = l / l0 - 1."""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms import elements


class Stretch(NamedTuple):
    """Elements: l0 (m,) rest length in m, area (m,) cross-section in m^2.

    geometric: whether the Hessian has the part across elements; without it, it is that of the
    tangent modulus alone, and Newton a quasi-Newton.
    """

    l0: np.ndarray
    area: np.ndarray
    geometric: bool


@jit
def evaluate(stretch, law, memory, shape, stiffness, projected):
    """Return E_s in J; add A sigma along, A sigma' / l0 along and A sigma / l across elements.

    An element is a material point of the ``law``. ``projected`` clips both stiffnesses at zero,
    which makes every element positive semi-definite.
    """
    total = 0.0
    for k in range(stretch.l0.size):
        l0, area, length = stretch.l0[k], stretch.area[k], shape.length[k]
        density, stress, tangent = law.respond(length / l0 - 1.0, memory, k)
        total += area * l0 * density
        along = area * tangent / l0
        across = area * stress / length if stretch.geometric else 0.0
        if projected:
            along, across = max(along, 0.0), max(across, 0.0)
        elements.stretch(shape, stiffness, k, area * stress, along, across)
    return total


@jit
def commit(stretch, law, memory, shape):
    """Let the law accept the strains of ``shape``; return how much less than E_s is stored, and
    what has been dissipated, J.
    """
    released, dissipated = 0.0, 0.0
    for k in range(stretch.l0.size):
        strain, volume = shape.length[k] / stretch.l0[k] - 1.0, stretch.area[k] * stretch.l0[k]
        potential = law.respond(strain, memory, k)[0]
        stored, lost = law.commit(strain, memory, k)
        released += volume * (potential - stored)
        dissipated += volume * lost
    return released, dissipated
