"""Relaxation: a law whose branches forget a share of its stress (quasi-linear viscoelasticity).

With the instantaneous stress s(e) = phi'(e) of an elastic law, branch i carries g_i (s(e) - s_i):

    stress = s - sum g_i s_i,   d s_i / dt = (s - s_i) / tau_i,   s_i = s(e_i) at its viscous strain

For a straight curve this is the generalised Maxwell model (Prony series); else Fung's model, with
shares of stress in place of stiffness. Where s rises with e it is a material with the energies

    stored = phi(e) - sum g_i (phi(e_i) + s_i (e - e_i))
    dissipation / time = sum g_i (s - s_i) (e - e_i) / tau_i >= 0

as phi is convex. A step of duration dt in which s changes evenly has with x_i = s - s_i the exact
x_i' = a_i x_i + c_i (s' - s), a_i = exp(-dt / tau_i), c_i = (1 - a_i) tau_i / dt, so that its
stress is a multiple of s plus a constant. Both follow from the potential

    scale phi(e) + slope e + const,   scale = 1 - sum g_i (1 - c_i),
                                      slope = sum g_i (a_i x_i - c_i s)

whose constant makes it the stored energy in a step without duration. A step thus costs hardly more
than an elastic one; only the commit goes through the branches. It also books the dissipation of the
elastic law where it softens (Mullins effect, `softening`).

Source: Y. C. Fung, Biomechanics, 1981. The energies follow by the Legendre transform of phi.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning

# Places in a state. ENERGY, STRESS and TANGENT are the response of the elastic law at STRAIN; from
# BRANCHES on there are all s_i, then all e_i. TANGENT is zero if the point was never strained.
STRAIN, STORED, MOST, ENERGY, STRESS, TANGENT, BRANCHES = range(7)
SMALL = 1e-2  # dt / tau below which `_square` is a series
NEAR = 1e-4  # difference of two strains below which a curve counts as straight: its energy is then
# wrong by less than 1e-8 of the energy at a strain of 1 %
TRIES = 60  # steps of Newton's method


class Pace(NamedTuple):
    """Data of a step that all points share.

    decay, gain (n,): a_i and c_i. square (n, 3): weights of x^2, x s. and s.^2 in the integral of
    x_i^2 / tau_i over the step, s. being the change of s. scale (1,).
    """

    decay: np.ndarray
    gain: np.ndarray
    square: np.ndarray
    scale: np.ndarray


@jit_exact
def _square(z, decay, gain):
    """Return the weights of `Pace.square` for z = dt / tau."""
    mixed = z * gain * gain
    if z < SMALL:
        last = z * (1.0 / 3.0 - z * (1.0 / 4.0 - z * (7.0 / 60.0 - z / 24.0)))
    else:
        last = (z - 2.0 * (1.0 - decay) + 0.5 * (1.0 - decay * decay)) / (z * z)
    return -0.5 * math.expm1(-2.0 * z), mixed, last


@jit_owning
def make_pace(law):
    """Return the `Pace` of a step without duration."""
    n = law.shares.size
    return Pace(np.ones(n), np.ones(n), np.zeros((n, 3)), np.ones(1))


@jit_exact
def set_pace(law, duration, pace):
    """Fill ``pace`` for steps of ``duration`` in s."""
    pace.scale[0] = 1.0
    for i in range(law.shares.size):
        z = duration / law.times[i]
        pace.decay[i] = math.exp(-z)
        pace.gain[i] = -math.expm1(-z) / z if z > 0.0 else 1.0
        pace.square[i, 0], pace.square[i, 1], pace.square[i, 2] = _square(
            z, pace.decay[i], pace.gain[i]
        )
        pace.scale[0] -= law.shares[i] * (1.0 - pace.gain[i])


@jit
def begin(law, memory, point):
    """Set slope and constant of the potential of a point for a step at the pace of ``memory``; do
    nothing if the point has no state.
    """
    if law.state_size() == 0:
        return
    state, pace, n, slope = memory.committed[point], memory.pace, law.shares.size, 0.0
    stress = state[STRESS]
    for i in range(n):
        x = stress - state[BRANCHES + i]
        slope += law.shares[i] * (pace.decay[i] * x - pace.gain[i] * stress)
    constant = state[STORED] - pace.scale[0] * state[ENERGY] - slope * state[STRAIN]
    memory.line[point, 0], memory.line[point, 1] = constant, slope


@jit
def _most(law, memory, point):
    """Return the greatest past energy W of a point, which only a softening law needs."""
    return memory.committed[point, MOST] if law.elastic.softening > 0.0 else 0.0


@jit
def respond(law, strain, memory, point):
    """Return the potential of the step (J/m^3), the stress and its tangent (Pa) at ``strain``."""
    if law.state_size() == 0:
        return law.elastic.respond(strain, 0.0)
    density, stress, tangent = law.elastic.respond(strain, _most(law, memory, point))
    scale, slope = memory.pace.scale[0], memory.line[point, 1]
    density = scale * density + slope * strain + memory.line[point, 0]
    return density, scale * stress + slope, scale * tangent


@jit_exact
def inverse(elastic, most, stress, guess):
    """Return the strain at which an elastic law whose stress rises has ``stress``, from a guess;
    and its complementary energy, the integral of strain over stress. most: see `softening`.
    """
    low, high, strain = elastic.least(), math.inf, guess
    for _ in range(TRIES):
        energy, response, tangent = elastic.respond(strain, most)
        gap = stress - response
        move = gap / tangent
        if abs(move) < NEAR:
            break
        low, high = (strain, high) if gap > 0.0 else (low, strain)
        if not low < strain + move < high:
            move = 0.5 * ((low if move < 0.0 else high) - strain)
        strain += move
    return strain + move, stress * strain - energy + 0.5 * move * gap


@jit
def _branch(law, most, strain, response, x, guess):
    """Return viscous strain, stored energy per share, and secant compliance of a branch whose
    stress is ``x`` per share. response: of the elastic law at ``strain``.
    """
    energy, stress, tangent = response
    if abs(x) < NEAR * tangent:
        return strain - x / tangent, 0.5 * x * x / tangent, 1.0 / tangent
    e, complement = inverse(law.elastic, most, stress - x, guess)
    return e, energy + complement - (stress - x) * strain, (strain - e) / x


@jit
def _soften(law, strain, most, state):
    """Raise the greatest past energy to ``most``; update the stored energy of a state."""
    n, response = law.shares.size, law.elastic.respond(strain, most)
    energy, stress, tangent = response
    stored = energy
    for i in range(n):
        x, guess = stress - state[BRANCHES + i], state[BRANCHES + n + i]
        e, kept, _ = _branch(law, most, strain, response, x, guess)
        state[BRANCHES + n + i] = e
        stored += law.shares[i] * (kept - energy)
    state[MOST], state[STORED] = most, stored
    state[ENERGY], state[STRESS], state[TANGENT] = energy, stress, tangent


@jit
def commit(law, strain, memory, point):
    """Accept ``strain``: update the state. Return potential less stored energy, and the dissipation
    of the step, J/m^3.

    The dissipation is exact where the curve is straight and the strain changes evenly.
    """
    if law.state_size() == 0:
        return 0.0, 0.0
    state, pace, n, dissipated = memory.committed[point], memory.pace, law.shares.size, 0.0
    before, past, most = state[STRAIN], state[STRESS], _most(law, memory, point)
    past_tangent = state[TANGENT] if state[TANGENT] != 0.0 else law.elastic.respond(0.0, 0.0)[2]
    response = law.elastic.respond(strain, most)
    energy, stress, tangent = response
    stored, change = energy, stress - past
    for i in range(n):
        weights, x, e = pace.square[i], past - state[BRANCHES + i], state[BRANCHES + n + i]
        work = weights[0] * x * x + weights[1] * x * change + weights[2] * change * change
        soft = 1.0 / past_tangent if abs(before - e) < NEAR else (before - e) / x
        x = pace.decay[i] * x + pace.gain[i] * change
        e, kept, softer = _branch(law, most, strain, response, x, e)
        state[BRANCHES + i], state[BRANCHES + n + i] = stress - x, e
        dissipated += 0.5 * law.shares[i] * (soft + softer) * work
        stored += law.shares[i] * (kept - energy)
    state[STRAIN], state[STORED] = strain, stored
    state[ENERGY], state[STRESS], state[TANGENT] = energy, stress, tangent
    greatest = law.elastic.greatest(strain, most)
    if greatest > most:
        _soften(law, strain, greatest, state)
    slope, constant = memory.line[point, 1], memory.line[point, 0]
    potential = pace.scale[0] * energy + slope * strain + constant
    return potential - state[STORED], dissipated + stored - state[STORED]


@jit
def state_size(law):
    """Return the length of the state of a point; 0 without branches and softening."""
    memory = law.shares.size > 0 or law.elastic.softening > 0.0
    return BRANCHES + 2 * law.shares.size if memory else 0


class Relaxing(NamedTuple):
    """elastic: `Softening` of the instantaneous stress, which rises with the strain if there are
    branches. shares (n,): g_i, which sum to less than 1. times (n,): tau_i in s. modulus: at the
    reference time, Pa.
    """

    elastic: object
    shares: np.ndarray
    times: np.ndarray
    modulus: float

    make_pace = make_pace
    set_pace = set_pace
    begin = begin
    respond = respond
    state_size = state_size
    commit = commit
