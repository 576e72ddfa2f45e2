"""Transverse shear that relaxes: branches of a spring and a dashpot in the shears of the edges.

The energy E of `shear` is quadratic in the shears g of the four edges, with a matrix K that depends
on the strain of the mid-surface. Branch i carries the share g_i of the force, which relaxes:

    force = K (g - sum g_i q_i),   dq_i/dt = (g - q_i) / tau_i

With `laws.relaxation`'s scale, a_i and c_i, and x_i = g - q_i at the start of a step in which g
changes evenly, the force at its end is

    K (scale g + slope),   slope = sum g_i (a_i x_i - c_i g_start)

That is an elastic shear, softer by ``scale``, whose rest shear is less by slope / scale. The
energies are

    stored = (1 - sum g_i) E(g) + sum g_i E(x_i),   dissipation / time = 2 sum g_i E(x_i) / tau_i

K is evaluated at the end of the step. The branches add a stress to the mid-surface, of second order
in the shear, as an elastic shear does.
"""

from kernels.compile.jit import jit, jit_exact
from kernels.plates.element import shear

LINE = 5  # number of data of an element for a step: shears at rest, constant of the energy
SHEAR, STORED, BRANCHES = 0, 4, 5  # places in a state; all x_i start at the last one


@jit
def _read(state, at):
    """Return the shears of four edges from ``at`` on."""
    return state[at], state[at + 1], state[at + 2], state[at + 3]


@jit
def _sum(a, g, b, h):
    """Return a g + b h."""
    return (
        a * g[0] + b * h[0],
        a * g[1] + b * h[1],
        a * g[2] + b * h[2],
        a * g[3] + b * h[3],
    )


@jit
def begin(law, memory, row, rest, surface, stiffness):
    """Set shears at rest and constant of an element for a step at the pace of ``memory``.

    law: its shares and times, as in `laws.relaxing_sheet`. rest (4,), surface, stiffness: see
    `shear`, at the start of the step.
    """
    state, pace, line = memory.committed[row], memory.pace, memory.line[row]
    start, scale = _read(state, SHEAR), pace.scale[0]
    slope = (0.0, 0.0, 0.0, 0.0)
    for i in range(law.shares.size):
        more = _sum(pace.decay[i], _read(state, BRANCHES + 4 * i), -pace.gain[i], start)
        slope = _sum(1.0, slope, law.shares[i], more)
    for k in range(4):
        line[k] = rest[k] - slope[k] / scale
    shifted = _sum(1.0, start, 1.0 / scale, slope)
    line[4] = state[STORED] - scale * shear.energy(shifted, surface, stiffness)


@jit
def of_step(memory, row, stiffness):
    """Return shears at rest, stiffnesses and the constant of the energy for the present step."""
    line, scale = memory.line[row], memory.pace.scale[0]
    return _read(line, 0), (scale * stiffness[0], scale * stiffness[1]), line[4]


@jit_exact
def commit(law, g, memory, row, surface, stiffness):
    """Accept the shears ``g`` of the edges: update the state. Return the stored energy and the
    dissipation of the step, J.
    """
    state, pace = memory.committed[row], memory.pace
    change = _sum(1.0, g, -1.0, _read(state, SHEAR))
    whole, gained = shear.energy(g, surface, stiffness), shear.energy(change, surface, stiffness)
    stored, dissipated = whole, 0.0
    for i in range(law.shares.size):
        at, weights = BRANCHES + 4 * i, pace.square[i]
        x = _read(state, at)
        before = shear.energy(x, surface, stiffness)
        mixed = shear.energy(_sum(1.0, x, 1.0, change), surface, stiffness) - before - gained
        work = 2.0 * weights[0] * before + weights[1] * mixed + 2.0 * weights[2] * gained
        dissipated += law.shares[i] * work
        x = _sum(pace.decay[i], x, pace.gain[i], change)
        stored += law.shares[i] * (shear.energy(x, surface, stiffness) - whole)
        for k in range(4):
            state[at + k] = x[k]
    for k in range(4):
        state[SHEAR + k] = g[k]
    state[STORED] = stored
    return stored, dissipated
