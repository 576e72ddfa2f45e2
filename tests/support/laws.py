"""Laws with memory, and a coupled section, for tests of the interface `kernels.terms.law`.

`StandardSolid`: a spring W0 beside a branch of a spring Y1 and a dashpot in series, whose strain is
q. Backward Euler from q over dt, with r = dt / time:

    W(e; q, dt) = W0(e) + 1/2 Y1 (e - q)^2 / (1 + r),   q' = q + r (e - q) / (1 + r)

It is the minimum over q' of W0 + 1/2 Y1 (e - q')^2 + 1/2 Y1 / r (q' - q)^2. The dashpot dissipates
twice the last part.

`Clock`: an elastic law that remembers how much time has passed.

`Bent`: the sections of an element of linear bending, whose two curvatures follow any law, as
`kernels.terms.section` has them.

`Section`: fibres of any law through the thickness of a wall. Its strain is a pair, the axial strain
e and the curvature kappa; a fibre at the height z has the strain e + z kappa.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms.law import Memory


@jit
def _branch(law, strain, memory, point):
    """Return r / (1 + r), which tends to 1 for a long step, and the strain of the branch's spring
    before the step.
    """
    flow = 1.0 if memory.duration == math.inf else memory.duration / (law.time + memory.duration)
    return flow, strain - memory.committed[point, 0]


@jit
def respond(law, strain, memory, point):
    density, stress, tangent = law.spring.respond(strain, memory, point)
    flow, before = _branch(law, strain, memory, point)
    rigid = law.branch * (1.0 - flow)
    return density + 0.5 * rigid * before * before, stress + rigid * before, tangent + rigid


@jit
def state_size(law):
    return 1


@jit
def commit(law, strain, memory, point):
    flow, before = _branch(law, strain, memory, point)
    memory.committed[point, 0] += flow * before
    after = (1.0 - flow) * before
    stored = law.spring.respond(strain, memory, point)[0] + 0.5 * law.branch * after * after
    return stored, law.branch * flow * before * after


class StandardSolid(NamedTuple):
    """spring: elastic law. branch: Y1, Pa. time: of relaxation at held strain, s. modulus: of
    spring and branch, Pa.
    """

    spring: object
    branch: float
    time: float
    modulus: float

    respond = respond
    state_size = state_size
    commit = commit


def standard_solid(spring, branch, time):
    """The law whose branch has ``branch`` times the modulus of its spring."""
    stiffness = branch * spring.modulus
    return StandardSolid(spring, stiffness, time, spring.modulus + stiffness)


@jit
def respond_as_spring(law, strain, memory, point):
    return law.spring.respond(strain, memory, point)


@jit
def commit_time(law, strain, memory, point):
    memory.committed[point, 0] += memory.duration
    return law.spring.respond(strain, memory, point)[0], 0.0


class Clock(NamedTuple):
    """spring: elastic law. modulus: of it, Pa."""

    spring: object
    modulus: float

    respond = respond_as_spring
    state_size = state_size
    commit = commit_time


@jit
def _fibre(section, memory, point):
    """Return the memory of the fibres at a point, a row each."""
    rows = section.height.size
    return Memory(memory.committed[point].reshape((rows, -1)), memory.duration)


@jit
def respond_section(section, strain, memory, point):
    fibres = _fibre(section, memory, point)
    energy, force, moment, axial, coupled, bending = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(section.height.size):
        z, weight = section.height[k], section.weight[k]
        density, stress, tangent = section.fibre.respond(strain[0] + z * strain[1], fibres, k)
        energy += weight * density
        force += weight * stress
        moment += weight * z * stress
        axial += weight * tangent
        coupled += weight * z * tangent
        bending += weight * z * z * tangent
    return energy, (force, moment), (axial, coupled, bending)


@jit
def section_state_size(section):
    return section.height.size * section.fibre.state_size()


@jit
def commit_section(section, strain, memory, point):
    fibres, stored, dissipated = _fibre(section, memory, point), 0.0, 0.0
    for k in range(section.height.size):
        kept, lost = section.fibre.commit(strain[0] + section.height[k] * strain[1], fibres, k)
        stored += section.weight[k] * kept
        dissipated += section.weight[k] * lost
    return stored, dissipated


class Section(NamedTuple):
    """height (k,): z of the fibres, m; weight (k,): area of each, m^2. modulus: of the fibre, Pa.

    Energies are then J/m, stresses a force in N and a moment in N m.
    """

    fibre: object
    height: np.ndarray
    weight: np.ndarray
    modulus: float

    respond = respond_section
    state_size = section_state_size
    commit = commit_section


@jit
def _sections(memory, point):
    """Return the memory of the two sections of an element, a row each."""
    return Memory(memory.committed[point].reshape((2, -1)), memory.duration)


@jit
def respond_bent(bent, strain, memory, point):
    rows = _sections(memory, point)
    one, slope1, rigid1 = bent.fibre.respond(strain[1], rows, 0)
    two, slope2, rigid2 = bent.fibre.respond(strain[2], rows, 1)
    slopes = 0.0, 2.0 * slope1, 2.0 * slope2
    return 2.0 * (one + two), slopes, (0.0, 0.0, 0.0, 2.0 * rigid1, 0.0, 2.0 * rigid2)


@jit
def bent_state_size(bent):
    return 2 * bent.fibre.state_size()


@jit
def commit_bent(bent, strain, memory, point):
    rows = _sections(memory, point)
    stored1, lost1 = bent.fibre.commit(strain[1], rows, 0)
    stored2, lost2 = bent.fibre.commit(strain[2], rows, 1)
    return 2.0 * (stored1 + stored2), 2.0 * (lost1 + lost2)


class Bent(NamedTuple):
    """fibre: law of the bending of a fibre. modulus: of it, Pa."""

    fibre: object
    modulus: float

    respond = respond_bent
    state_size = bent_state_size
    commit = commit_bent
