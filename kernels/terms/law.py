"""What a material answers at a point: the interface between the terms and the laws.

A *law* is a named tuple of parameters whose class has the verbs of `Law`; a term calls them at each
of its material points. With the strain e that is minimised over, the state q that was committed
last and the duration of the step,

    potential W(e; q, duration),   stress dW/de,   tangent d2W/de2

is all that a step needs of it: the step stays a minimisation. For a law without memory W is the
stored energy. A law with memory minimises over its internal variables itself, so that W is its
incremental potential: stored energy and the dissipation potential of the step, which for a viscous
law is half of what is dissipated. At commit it tells stored and dissipated energy apart, for the
energy book.

A virgin state is zero. A duration of 0 is allowed: no time passes, and what needs time to change
does not.

A strain with several components (axial strain and curvature of a section, three of a plate) is a
tuple, and so is its stress; the tangent is then the upper triangle, row by row.
"""

from typing import NamedTuple, Protocol

import numpy as np


class Memory(NamedTuple):
    """What a law may know beside the strain.

    committed (p, k): state at each material point when the last step was accepted; only `commit`
    changes it. No points where nothing remembers. duration: of the step, s.
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

    def remembers(self):
        """Return how many numbers are kept at each point; 0, as a constant, for a law without
        memory: its commit then costs nothing.
        """

    def commit(self, strain, memory, point):
        """Accept ``strain``: renew the committed state; return what is stored then and what has
        been dissipated in the step, J/m^3.
        """
