"""A sheet that relaxes: quasi-linear viscoelasticity in logarithmic strains.

With the elastic energy W of a `sheet` as a function of L = ln(c) / 2 and its stress s = dW/dL (the
Kirchhoff stress, in axes that turn with the material), branch i carries g_i (s - s_i):

    stress = s - sum g_i s_i,   ds_i/dt = (s - s_i) / tau_i,   s_i = s(L_i) at its viscous strain

which is `relaxation` with strains and stresses of three components: shares, times and steps are the
same, and so are the potential of a step, scale W + slope : L + const, and the energies

    stored = W(L) - sum g_i (W(L_i) + s_i : (L - L_i))
    dissipation / time = sum g_i (s - s_i) : (L - L_i) / tau_i >= 0

as W is convex in L where h rises (`separable`). A sheet under uniaxial stress relaxes like a wall
with the same curve of Cauchy stress over ln l. The viscous strain of a branch has the axes of its
stress.

The dissipation of a step is exact for small strains whose stress changes evenly.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.laws import log_strain
from kernels.laws.relaxation import make_pace, set_pace

LINE = 4  # number of data of a point for a step: constant, slope
STRESS, STRAIN, ENERGY, STORED, BRANCHES = 0, 3, 6, 7, 8  # places in a state; then all s_i, all L_i
NEAR = 1e-5  # change of a logarithm of stretch below which `inverse` ends: energies err by its cube
LONGEST = 1.0  # greatest change of such a logarithm in one step of Newton's method
TRIES = 60


@jit
def _inner(s, e):
    """Return s : e."""
    return s[0] * e[0] + s[1] * e[1] + 2.0 * s[2] * e[2]


@jit
def _read(state, at):
    """Return the three components from ``at`` on."""
    return state[at], state[at + 1], state[at + 2]


@jit
def _write(state, at, s):
    """Write three components."""
    state[at], state[at + 1], state[at + 2] = s[0], s[1], s[2]


@jit
def _response(law, a, b, v):
    """Return W, s = 2 c dW/dc and L of the elastic sheet."""
    energy, g, _ = law.elastic.respond(a, b, v)
    half = 0.5 * g[2]
    s = (
        2.0 * ((1.0 + a) * g[0] + v * half),
        2.0 * ((1.0 + b) * g[1] + v * half),
        2.0 * ((1.0 + a) * half + v * g[1]),
    )
    return energy, s, log_strain.strain(a, b, v)


@jit
def _principal(s):
    """Return both principal values, and the cosine and the sine of twice the angle of the first."""
    mean, u = 0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1])
    r = math.sqrt(u * u + s[2] * s[2])
    cosine, sine = (u / r, s[2] / r) if r > 0.0 else (1.0, 0.0)
    return mean + r, mean - r, cosine, sine


@jit_exact
def inverse(elastic, s, guess):
    """Return the strain L at which a `sheet` has the stress ``s``, from a guess, and its
    complementary energy s : L - W. Both are 11, 22, 12.
    """
    s1, s2, cosine, sine = _principal(s)
    mean, half = 0.5 * (guess[0] + guess[1]), 0.5 * (guess[0] - guess[1]) * cosine
    half += guess[2] * sine
    x1, x2, complement = mean + half, mean - half, 0.0
    for _ in range(TRIES):
        w1, h1, d1 = elastic.of_stretch(x1)
        w2, h2, d2 = elastic.of_stretch(x2)
        w3, h3, d3 = elastic.of_stretch(-x1 - x2)
        r1, r2 = s1 - h1 + h3, s2 - h2 + h3
        by = 1.0 / (d1 * d2 + d3 * (d1 + d2))
        move1, move2 = by * ((d2 + d3) * r1 - d3 * r2), by * ((d1 + d3) * r2 - d3 * r1)
        largest = max(abs(move1), abs(move2))
        complement = s1 * x1 + s2 * x2 - (w1 + w2 + w3) + 0.5 * (r1 * move1 + r2 * move2)
        share = min(1.0, LONGEST / largest) if largest > 0.0 else 1.0
        x1, x2 = x1 + share * move1, x2 + share * move2
        if largest < NEAR:
            break
    mean, half = 0.5 * (x1 + x2), 0.5 * (x1 - x2)
    return (mean + half * cosine, mean - half * cosine, half * sine), complement


@jit
def begin(law, memory, point):
    """Set slope and constant of the potential of a point for a step at the pace of ``memory``."""
    state, pace, line = memory.committed[point], memory.pace, memory.line[point]
    s, at = _read(state, STRESS), BRANCHES
    for k in range(3):
        line[1 + k] = 0.0
    for i in range(law.shares.size):
        decay, gain = law.shares[i] * pace.decay[i], law.shares[i] * pace.gain[i]
        for k in range(3):
            line[1 + k] += decay * (s[k] - state[at + k]) - gain * s[k]
        at += 3
    past = _inner(_read(line, 1), _read(state, STRAIN))
    line[0] = state[STORED] - pace.scale[0] * state[ENERGY] - past


@jit
def respond(law, a, b, v, memory, point):
    """Return the potential of the step, its slopes and second derivatives as `sheet.respond`."""
    energy, g, t = law.elastic.respond(a, b, v)
    if law.shares.size == 0 or math.isinf(energy):
        return energy, g, t
    line, scale = memory.line[point], memory.pace.scale[0]
    more, dg, dt = log_strain.respond(_read(line, 1), a, b, v)
    return (
        scale * energy + more + line[0],
        (scale * g[0] + dg[0], scale * g[1] + dg[1], scale * g[2] + dg[2]),
        (
            scale * t[0] + dt[0],
            scale * t[1] + dt[1],
            scale * t[2] + dt[2],
            scale * t[3] + dt[3],
            scale * t[4] + dt[4],
            scale * t[5] + dt[5],
        ),
    )


@jit
def _less(a, factor, b):
    """Return a - factor b."""
    return a[0] - factor * b[0], a[1] - factor * b[1], a[2] - factor * b[2]


@jit_exact
def commit(law, a, b, v, memory, point):
    """Accept a strain: update the state. Return the stored energy and the dissipation of the step,
    J/m^3.

    With x = s - s_i and its strain d = L - L_i at both ends of the step, x' = a_i x + c_i (s' - s)
    gives the part of d that the change of the stress has added, (d' - a_i d) / c_i.
    """
    state, pace, n = memory.committed[point], memory.pace, law.shares.size
    before, past = _read(state, STRESS), _read(state, STRAIN)
    energy, s, strain = _response(law, a, b, v)
    change = _less(s, 1.0, before)
    stored, dissipated = energy, 0.0
    for i in range(n):
        at, to = BRANCHES + 3 * i, BRANCHES + 3 * (n + i)
        decay, gain, weights = pace.decay[i], pace.gain[i], pace.square[i]
        x, d = _less(before, 1.0, _read(state, at)), _less(past, 1.0, _read(state, to))
        own = _less(_less(s, decay, x), gain, change)
        viscous, complement = inverse(law.elastic, own, _read(state, to))
        added = _less(_less(strain, 1.0, viscous), decay, d)
        work = weights[0] * _inner(x, d)
        work += 0.5 * weights[1] * (_inner(x, added) / gain + _inner(change, d))
        work += weights[2] * _inner(change, added) / gain
        dissipated += law.shares[i] * work
        stored += law.shares[i] * (complement - _inner(own, strain))
        _write(state, at, own)
        _write(state, to, viscous)
    _write(state, STRESS, s)
    _write(state, STRAIN, strain)
    state[ENERGY], state[STORED] = energy, stored
    return stored, dissipated


@jit
def state_size(law):
    """Return the length of the state of a point; 0 without branches."""
    return BRANCHES + 6 * law.shares.size if law.shares.size > 0 else 0


class RelaxingSheet(NamedTuple):
    """elastic: `sheet.Sheet` of the instantaneous stress. shares (n,): g_i, which sum to less than
    1; n = 0 for an elastic material. times (n,): tau_i in s. shear_modulus: of ``elastic``, Pa.

    Scenes of all materials have this one law, so that their kernels are the same machine code.
    """

    elastic: object
    shares: np.ndarray
    times: np.ndarray
    shear_modulus: float

    make_pace = make_pace
    set_pace = set_pace
    begin = begin
    respond = respond
    state_size = state_size
    commit = commit
