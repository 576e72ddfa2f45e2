"""The interface between the terms and the material laws: the response at a material point.

A *law* is a named tuple of parameters whose class has the verbs of `Law`; a term calls them at each
of its material points. A step, which stays a minimisation, needs only

    potential W(e; q, duration),   stress dW/de,   tangent d2W/de2

with the strain e, the state q committed last and the duration of the step. Without memory W is the
stored energy. A law with memory minimises over its internal variables itself, so that W is its
incremental potential. At commit it separates stored from dissipated energy, for the energy book.
The state is kept in `solve.history.State.memory`, which `planar.steps.commit` updates; a law
without memory keeps none.

The initial state is zero. With a duration of zero the state does not change, and W is the stored
energy. The law of a `section` has several points with one strain each.
"""

from typing import NamedTuple, Protocol

import numpy as np


class Memory(NamedTuple):
    """The data that a response depends on besides the strain.

    committed (p, k): state of each material point after the last accepted step, which only `commit`
    changes; p = 0 if no law has memory. line (p, j): data of a point for the present step, which
    `begin` sets. pace: data of the step that all points share, which `set_pace` sets.
    """

    committed: np.ndarray
    line: np.ndarray
    pace: object


class Law(Protocol):
    """The verbs of a law; ``point``: number of the material point, row of `Memory.committed`.

    modulus: slope at the origin, Pa. is_elastic: without memory.
    """

    modulus: float
    is_elastic: bool

    def make_pace(self):
        """Return the data of a step that all points share, for `set_pace` to fill."""

    def set_pace(self, duration, pace):
        """Fill ``pace`` for steps of ``duration`` in s."""

    def begin(self, memory, point):
        """Set the data of a point for the present step."""

    def elastic(self):
        """Return the elastic law alone, if the law ``is_elastic``: code compiled for it spends no
        time on a memory.
        """

    def respond(self, strain, memory, point):
        """Return potential (J/m^3), stress (Pa) and tangent (Pa) at ``strain``."""

    def state_size(self):
        """Return the length of the state of a point; if it is 0 (no memory), only `respond` is
        called.
        """

    def commit(self, strain, memory, point):
        """Accept ``strain``: update the committed state.

        Return (released, dissipated), J/m^3: potential less stored energy, and the dissipation of
        the step.
        """


def in_python(law, name):
    """Return the number that the verb ``name`` of a law returns, without compiling it."""
    verb = getattr(type(law), name)
    return getattr(verb, "__wrapped__", verb)(law)
