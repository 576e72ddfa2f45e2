"""State of a march between steps: positions, rates, stored energies, memory and energy book."""

from typing import NamedTuple

import numpy as np

BOOK = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("work", np.float64),  # of external forces; all entries in J
            ("kinetic", np.float64),
            ("material", np.float64),  # dissipated by damping and by the material
            ("friction", np.float64),  # dissipated
            ("integrator", np.float64),  # lost by the integrator
            ("injected", np.float64),  # by projection after steps
            ("residual", np.float64),  # work + injected less all other entries and stored energies
        ],
    )
)
TOTALS = np.dtype(
    (
        np.record,
        [
            ("iterations", np.float64),  # of Newton
            ("steps", np.float64),
            ("time", np.float64),  # s
            ("last", np.float64),  # duration of the last step, s; 0: no previous step
            ("reaction", np.float64),  # at the driven coordinate after the last step, N
            ("largest_reaction", np.float64),  # of any step, without sign, N
            ("factor", np.float64),  # load factor after the last step
            ("force", np.float64),  # largest force of any step, N (`resolution`)
        ],
    )
)


class Rates(NamedTuple):
    """Rates (n,) at the start of the next step (`integrators`).

    position: x'. velocity: v'. change: acceleration after the last step; where a coordinate is not
    heavy, its mean velocity in the last step.
    """

    position: np.ndarray
    velocity: np.ndarray
    change: np.ndarray


class Gradients(NamedTuple):
    """Gradients (n,) after the last step in N: of stored energy, damping and friction."""

    elastic: np.ndarray
    material: np.ndarray
    friction: np.ndarray


class State(NamedTuple):
    """State between steps. x, v (n,): positions and velocities. lagged (n,): positions at which
    friction was lagged last. stored (k,): stored energies in J, one for each kind that the problem
    distinguishes. memory (p, m): committed state of the laws at p material points, empty for
    elastic laws. book, totals (1,): see `BOOK` and `TOTALS`.
    """

    x: np.ndarray
    v: np.ndarray
    lagged: np.ndarray
    rates: Rates
    gradients: Gradients
    stored: np.ndarray
    memory: np.ndarray
    book: np.ndarray
    totals: np.ndarray


def at_rest(x, stored, memory=(0, 0)):
    """Return the `State` at rest at ``x`` (n,), with ``stored`` kinds of stored energy and a virgin
    material. memory: shape of `State.memory`.
    """
    n = x.size
    rates, gradients = Rates(*np.zeros((3, n))), Gradients(*np.zeros((3, n)))
    book, totals = np.zeros(1, BOOK), np.zeros(1, TOTALS)
    energies, points = np.zeros(stored), np.zeros(memory)
    return State(x.copy(), np.zeros(n), x.copy(), rates, gradients, energies, points, book, totals)
