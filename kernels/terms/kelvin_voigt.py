"""Viscous stress and moment, proportional to the rates of strain and turn of each element.

    D = rate / 2 sum [ Y A l0 de^2 + k_11 da_1^2 + 2 k_12 da_1 da_2 + k_22 da_2^2 ], rate = tau / h

de, da: changes of strain and turns since y (`solve.integrators`). As y is extrapolated in strains
and turns instead of positions, a rigid motion dissipates nothing.
"""

from kernels.compile.jit import jit
from kernels.terms import stretch


@jit
def _bend(bend, before, rate, k, shape, resultants):
    """Return the part of D that is due to the turns of element ``k``; add its derivatives."""
    k11, k12, k22 = bend.stiffness[0, k], bend.stiffness[1, k], bend.stiffness[2, k]
    one, two = shape.turn[0, k] - before.turn[0, k], shape.turn[1, k] - before.turn[1, k]
    first, second = rate * (k11 * one + k12 * two), rate * (k12 * one + k22 * two)
    resultants.force[1, k] += first
    resultants.force[2, k] += second
    resultants.rigidity[3, k] += rate * k11
    resultants.rigidity[4, k] += rate * k12
    resultants.rigidity[5, k] += rate * k22
    return 0.5 * (first * one + second * two)


@jit
def measure(scene, shape, strain):
    """Fill the ``strain`` (m,) of every element."""
    for k in range(strain.size):
        strain[k] = stretch.strain(scene.stretch, shape, k)[0]


@jit
def advance(scene, v, time, shape, strain):
    """Extrapolate ``strain`` (m,) and the turns of ``shape`` by ``time`` (s) at the velocities
    ``v`` (n,).
    """
    dofs = scene.walls.dofs
    for k in range(strain.size):
        ex, ey = v[dofs[k, 3]] - v[dofs[k, 0]], v[dofs[k, 4]] - v[dofs[k, 1]]
        tx, ty = shape.t[0, k], shape.t[1, k]
        bearing = (tx * ey - ty * ex) / shape.length[k]
        one, two = bearing - v[dofs[k, 2]], bearing - v[dofs[k, 5]]
        _, of_one, of_two = stretch.strain(scene.stretch, shape, k)
        along = (tx * ex + ty * ey) / scene.stretch.l0[k]
        strain[k] += time * (along + of_one * one + of_two * two)
        shape.turn[0, k] += time * one
        shape.turn[1, k] += time * two


@jit
def extrapolate(scene, shape, strain, past, share):
    """Extrapolate ``strain`` (m,) and the turns of ``shape`` by a ``share`` of their change since
    the shape ``past``.
    """
    for k in range(strain.size):
        strain[k] += share * (strain[k] - stretch.strain(scene.stretch, past, k)[0])
        for end in range(2):
            shape.turn[end, k] += share * (shape.turn[end, k] - past.turn[end, k])


@jit
def evaluate(scene, before, rate, shape, resultants):
    """Return D in J; write its derivatives into ``resultants``. before: `damping.Before`, with
    strains and turns at y, from which rates are measured.
    """
    total, viscosity = 0.0, rate * scene.law.modulus
    for k in range(shape.length.size):
        volume = scene.stretch.area[k] * scene.stretch.l0[k]
        strain, one, two = stretch.strain(scene.stretch, shape, k)
        change = strain - before.strain[k]
        stress = viscosity * change
        total += 0.5 * volume * stress * change
        stretch.push(scene.stretch, resultants, k, volume, (one, two), stress, viscosity, False)
        total += _bend(scene.bend, before.shape, rate, k, shape, resultants)
    return total
