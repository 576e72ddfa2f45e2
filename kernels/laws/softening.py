"""Softening on reloading (Mullins): below its greatest past strain a wall is softer than at first.

With the energy W(e) of the curve and its greatest past value W_m, below W_m

    stress = eta W'(e),   eta = 1 - erf((W_m - W) / b) / r,   b = m + beta W_m

and beyond W_m the stress of the curve itself. The potential is a function of W alone,

    phi = W - (I(W_m / b) - I((W_m - W) / b)) b / r,   I(u) = u erf(u) + exp(-u^2) / sqrt(pi)

up to W_m, from where it rises as W does. As W_m grows, phi falls at the same strain: this energy is
dissipated, and booked when `relaxation` commits.

Source: R. W. Ogden and D. G. Roxburgh, A pseudo-elastic model for the Mullins effect, 1999; beta:
Abaqus Theory Guide, 4.7.1.
"""

import math
from typing import NamedTuple

from kernels.compile.jit import jit

BY_ROOT_PI = 1.0 / math.sqrt(math.pi)


@jit
def _integral(u):
    """Return I(u)."""
    return u * math.erf(u) + BY_ROOT_PI * math.exp(-u * u)


@jit
def _lost(law, energy, most):
    """Return W - phi at an ``energy`` W that is at most W_m."""
    b = law.m + law.beta * most
    return (_integral(most / b) - _integral((most - energy) / b)) * b * law.softening


@jit
def respond(law, strain, most):
    """Return phi (J/m^3), stress and tangent (Pa) at ``strain``. most: W_m, J/m^3."""
    energy, stress, tangent = law.curve.respond(strain)
    if law.softening == 0.0 or most == 0.0:
        return energy, stress, tangent
    if energy > most:
        return energy - _lost(law, most, most), stress, tangent
    b = law.m + law.beta * most
    u = (most - energy) / b
    eta = 1.0 - law.softening * math.erf(u)
    slope = 2.0 * BY_ROOT_PI * law.softening / b * math.exp(-u * u)
    tangent = eta * tangent + slope * stress * stress
    return energy - _lost(law, energy, most), eta * stress, tangent


@jit
def greatest(law, strain, most):
    """Return the greatest energy W so far, including W at ``strain``; ``most`` if the law does not
    soften.
    """
    return max(most, law.curve.respond(strain)[0]) if law.softening > 0.0 else most


@jit
def least(law):
    """Return the strain at which the stress tends to minus infinity."""
    return law.curve.least()


class Softening(NamedTuple):
    """curve: elastic law. softening: 1 / r, below 1; zero: none. m: J/m^3. beta: a number."""

    curve: object
    softening: float
    m: float
    beta: float

    respond = respond
    greatest = greatest
    least = least
