"""The interface between the terms and the material laws: the response at a material point.

A *law* is a named tuple of parameters whose class has the verbs of `Law`; a term calls them at each
of its material points. A step, which stays a minimisation, needs only

    potential W(e; q, duration),   stress dW/de,   tangent d2W/de2

with the strain e, the state q committed last and the duration of the step. For a law without memory
W is the stored energy. A law with memory minimises over its internal variables itself, so that W is
its incremental potential: stored energy plus the dissipation potential of the step, which for a
viscous law is half of the dissipation. At commit it returns stored and dissipated energy
separately, for the energy book. The curves of `elastic` have no memory. The state of other laws is
kept in `solve.history.State.memory`, which `planar.steps.commit` updates.

The initial state is zero. With a duration of zero the state does not change.

A strain with several components (axial strain and curvature of a section, three of a plate) is a
tuple, and so is its stress; the tangent is then the upper triangle, row by row.
"""

from typing import NamedTuple, Protocol

import numpy as np


class Memory(NamedTuple):
    """What a response depends on beside the strain.

    committed (p, k): state of each material point after the last accepted step, which only `commit`
    changes; p = 0 if no law has memory. duration: of the step, s.
    """

    committed: np.ndarray
    duration: float


class Law(Protocol):
    """The verbs of a law; ``point``: number of the material point, row of `Memory.committed`.

    modulus: slope at the origin, Pa.
    """

    modulus: float

    def respond(self, strain, memory, point):
        """Return potential (J/m^3), stress (Pa) and tangent (Pa) at ``strain``."""

    def state_size(self):
        """Return the length of the state of a point; 0, as a constant, without memory: the commit
        then costs nothing.
        """

    def commit(self, strain, memory, point):
        """Accept ``strain``: update the committed state.

        Return the stored energy and the dissipation of the step, J/m^3.
        """
