"""Yielding: a law that is linear elastic up to a yield stress, then plastic with linear hardening.

The stress is Y (e - e_p) with the plastic strain e_p, and at most sigma_y + H alpha in magnitude,
alpha being the sum of all |d e_p| (isotropic hardening). In a step from e_p and alpha to a strain
e, with the trial stress s = Y (e - e_p), e_p changes by

    d = max(|s| - sigma_y - H alpha, 0) / (Y + H)   towards s

which minimises 1/2 Y (e - e_p - d sign s)^2 + (sigma_y + H alpha) d + 1/2 H d^2: the elastic energy
and the plastic work, all of which is dissipated. Below `elastic.GUARD` a wall has the barrier of
its elastic law.

Source: J. C. Simo and T. J. R. Hughes, Computational Inelasticity, 1998, chapter 1.
"""

from typing import NamedTuple

from kernels.compile.jit import jit
from kernels.laws.elastic import guard

PLASTIC, PATH = range(2)  # places in the state of a point: e_p and alpha
STATE = 2


@jit
def _flow(law, strain, memory, point):
    """Return d, the elastic strain after the step, and the yield stress before it."""
    state = memory.committed[point]
    elastic, limit = strain - state[PLASTIC], law.limit + law.hardening * state[PATH]
    d = max(law.modulus * abs(elastic) - limit, 0.0) / (law.modulus + law.hardening)
    return d, elastic - d if elastic > 0.0 else elastic + d, limit


@jit
def respond(law, strain, memory, point):
    """Return the potential of the step (J/m^3), the stress and its tangent (Pa) at ``strain``."""
    d, elastic, limit = _flow(law, strain, memory, point)
    stress, tangent = law.modulus * elastic, law.modulus
    density = 0.5 * stress * elastic
    if d > 0.0:
        density += d * (limit + 0.5 * law.hardening * d)
        tangent *= law.hardening / (law.modulus + law.hardening)
    value, slope, curvature = guard(law.guarded, strain)
    return density + value, stress + slope, tangent + curvature


@jit
def commit(law, strain, memory, point):
    """Accept ``strain``: update plastic strain and hardening. Return potential less stored energy,
    and the dissipation of the step, J/m^3, which are equal.
    """
    d, elastic, limit = _flow(law, strain, memory, point)
    state = memory.committed[point]
    state[PLASTIC] = strain - elastic
    state[PATH] += d
    dissipated = d * (limit + 0.5 * law.hardening * d)
    return dissipated, dissipated


class Yielding(NamedTuple):
    """modulus: Y. limit: sigma_y; zero: the law is not in use. hardening: H. guarded: modulus of
    the barrier, zero for none. All in Pa.
    """

    modulus: float
    limit: float
    hardening: float
    guarded: float

    respond = respond
    commit = commit
