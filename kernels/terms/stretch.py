"""Stretching of straight elements: E_s = sum A l0 W(e), nominal strain e = l / l0 - 1."""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms import elements


class Stretch(NamedTuple):
    """Elements: l0 (m,) rest length in m, area (m,) cross-section in m^2.

    geometric: whether the Hessian has its geometric part, across elements. Without that it is the
    material tangent alone, and the iteration is a quasi-Newton method.
    """

    l0: np.ndarray
    area: np.ndarray
    geometric: bool


@jit
def evaluate(stretch, law, memory, shape, stiffness, projected):
    """Return E_s in J; add its derivatives: the force A sigma along elements, the stiffness
    A sigma' / l0 along and A sigma / l across them.

    Elements are the material points of the ``law``. projected: both stiffnesses are clipped at
    zero, which makes every element positive semi-definite.
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
    """Commit the strains of ``shape`` to the law.

    Return (released, dissipated) in J: E_s less the stored energy, and the dissipation of the step.
    """
    released, dissipated = 0.0, 0.0
    for k in range(stretch.l0.size):
        strain, volume = shape.length[k] / stretch.l0[k] - 1.0, stretch.area[k] * stretch.l0[k]
        potential = law.respond(strain, memory, k)[0]
        stored, lost = law.commit(strain, memory, k)
        released += volume * (potential - stored)
        dissipated += volume * lost
    return released, dissipated
