"""The law of a material point: elastic, with or without relaxation and softening; or yielding.

Scenes of all materials have this one law, so that their kernels are the same machine code.
"""

from typing import NamedTuple

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.laws.elastic import Elastic
from kernels.laws.yielding import STATE


@jit_owning
def make_pace(law):
    """Return the data of a step that all points share."""
    return law.relaxing.make_pace()


@jit_exact
def set_pace(law, duration, pace):
    """Fill ``pace`` for steps of ``duration`` in s."""
    law.relaxing.set_pace(duration, pace)


@jit
def begin(law, memory, point):
    """Set the data of a point for the present step."""
    if law.yielding.limit == 0.0:
        law.relaxing.begin(memory, point)


@jit
def respond(law, strain, memory, point):
    """Return potential (J/m^3), stress (Pa) and tangent (Pa) at ``strain``."""
    if law.yielding.limit == 0.0:
        return law.relaxing.respond(strain, memory, point)
    return law.yielding.respond(strain, memory, point)


@jit
def commit(law, strain, memory, point):
    """Accept ``strain``. Return potential less stored energy, and the dissipation, J/m^3."""
    if law.yielding.limit == 0.0:
        return law.relaxing.commit(strain, memory, point)
    return law.yielding.commit(strain, memory, point)


@jit
def state_size(law):
    """Return the length of the state of a point; 0 without memory."""
    return STATE if law.yielding.limit > 0.0 else law.relaxing.state_size()


@jit
def elastic(law):
    """Return the curve of a law without memory as an `elastic.Elastic` law."""
    return Elastic(law.relaxing.elastic.curve)


class Fibre(NamedTuple):
    """relaxing: `relaxation.Relaxing`. yielding: `yielding.Yielding`, which acts alone if it has a
    limit. modulus: slope at the origin at the reference time, Pa. is_elastic: without memory.
    """

    relaxing: object
    yielding: object
    modulus: float
    is_elastic: bool

    elastic = elastic
    make_pace = make_pace
    set_pace = set_pace
    begin = begin
    respond = respond
    state_size = state_size
    commit = commit
