"""Where a march is: positions, rates, the energy book and what the next step starts from."""

from typing import NamedTuple

import numpy as np

BOOK = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            ("work", np.float64),  # done on the problem, J, as all
            ("kinetic", np.float64),
            ("material", np.float64),  # dissipated by damping and by the material
            ("friction", np.float64),
            ("integrator", np.float64),
            ("injected", np.float64),  # by projection after a step
            ("residual", np.float64),  # what is left over
        ],
    )
)
TOTALS = np.dtype(
    (
        np.record,
        [
            ("iterations", np.float64),
            ("steps", np.float64),
            ("time", np.float64),  # s
            ("last", np.float64),  # duration of the last step, s; 0 to set out anew
            ("reaction", np.float64),  # of the driven coordinate at the end of the last step, N
            ("factor", np.float64),  # of the load then
        ],
    )
)


class Rates(NamedTuple):
    """Rates (n,) that the next step sets out with (`integrators`).

    position: of x. velocity: of v. change: last acceleration; of what is not heavy, the mean
    velocity in the last step.
    """

    position: np.ndarray
    velocity: np.ndarray
    change: np.ndarray


class Past(NamedTuple):
    """Gradients (n,) at the end of the last step, N: of stored energy, damping and friction."""

    elastic: np.ndarray
    material: np.ndarray
    friction: np.ndarray


class State(NamedTuple):
    """Where a march is. x, v (n,): position and velocity. stored (k,): energies in J, as many as
    the problem tells apart. memory (p, m): what the material remembers at p points, empty where it
    does not. book, totals (1,): see `BOOK` and `TOTALS`.
    """

    x: np.ndarray
    v: np.ndarray
    rates: Rates
    past: Past
    stored: np.ndarray
    memory: np.ndarray
    book: np.ndarray
    totals: np.ndarray


def at_rest(x, stored, memory=(0, 0)):
    """Return the `State` of a march that begins at ``x`` (n,), with ``stored`` energies to tell and
    a virgin material that remembers ``memory`` (points, numbers at each).
    """
    n = x.size
    rates, past = Rates(*np.zeros((3, n))), Past(*np.zeros((3, n)))
    book, totals = np.zeros(1, BOOK), np.zeros(1, TOTALS)
    return State(
        x.copy(), np.zeros(n), rates, past, np.zeros(stored), np.zeros(memory), book, totals
    )
