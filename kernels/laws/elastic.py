"""Elastic laws: stress as a piecewise cubic of strain, and its exact integral.

    sigma(e) = c0 + c1 s + c2 s^2 + c3 s^3,   s = e - knot_i,      W(e) = integral_0^e sigma

Beyond either end the curve continues along its tangent. `ElasticCurve` is the nominal stress of a
wall over its nominal strain; below ``GUARD`` a C2 barrier is added that is infinite at e = -1, so
that no element vanishes or turns over. `FibreCurve` is the same curve for a fibre of a bent
section, without the barrier: the centre line keeps walls from vanishing.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.laws.barrier import barrier

GUARD = -0.7


@jit
def piece(law, strain):
    """Return the index of the cubic at ``strain``, clipped to the first or the last one."""
    knots, low, high = law.knots, 0, law.knots.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if knots[middle] <= strain:
            low = middle
        else:
            high = middle
    return low


@jit
def curve(law, strain):
    """Return W, sigma and its tangent on the measured curve, continued by tangents."""
    i = law.piece(strain)
    inside = min(max(strain, law.knots[0]), law.knots[-1])
    s = inside - law.knots[i]
    c = law.coefficients[i]
    tangent = c[1] + s * (2.0 * c[2] + s * 3.0 * c[3])
    stress = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    density = law.energy[i] + s * (c[0] + s * (c[1] / 2 + s * (c[2] / 3 + s * c[3] / 4)))
    beyond = strain - inside
    density += beyond * (stress + 0.5 * beyond * tangent)
    return density, stress + beyond * tangent, tangent


@jit
def guard(modulus, strain):
    """Return the barrier, zero above ``GUARD``, and its two derivatives."""
    if strain >= GUARD or modulus == 0.0:
        return 0.0, 0.0, 0.0
    width = 1.0 + GUARD
    value, slope, curvature = barrier((1.0 + strain) / width)
    return modulus * width * width * value, modulus * width * slope, modulus * curvature


@jit
def respond(law, strain):
    """Return energy density W (J/m^3), nominal stress sigma (Pa) and tangent (Pa) at ``strain``."""
    density, stress, tangent = curve(law, strain)
    value, slope, curvature = guard(law.modulus, strain)
    return density + value, stress + slope, tangent + curvature


@jit
def least(law):
    """Return the strain at which the barrier makes the stress tend to minus infinity."""
    return -1.0


@jit
def least_of_fibre(law):
    """Return minus infinity: the stress of a fibre is finite at any strain."""
    return -math.inf


class ElasticCurve(NamedTuple):
    """Stress-strain curve of a wall.

    knots (k,): nominal strain. coefficients (k - 1, 4): Pa. energy (k,): W at the knots, J/m^3.
    modulus: slope at the origin, Pa; the scale of the guard.
    """

    knots: np.ndarray
    coefficients: np.ndarray
    energy: np.ndarray
    modulus: float

    piece = piece
    respond = respond
    least = least


class FibreCurve(NamedTuple):
    """Stress-strain curve of a fibre; fields as in `ElasticCurve`."""

    knots: np.ndarray
    coefficients: np.ndarray
    energy: np.ndarray
    modulus: float

    piece = piece
    respond = curve
    least = least_of_fibre


@jit
def respond_at_point(law, strain, memory, point):
    """Return potential, stress and tangent of the curve; no point has a memory."""
    return law.curve.respond(strain)


@jit
def state_size(law):
    """Return 0 as a constant, so that code for a memory is not even compiled."""
    return 0


class Elastic(NamedTuple):
    """A curve as a `law.Law` without memory."""

    curve: object

    respond = respond_at_point
    state_size = state_size
