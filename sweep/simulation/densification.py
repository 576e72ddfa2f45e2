"""Densification of a crushed lattice: energy, force and strain at the greatest efficiency.

The efficiency of energy absorption, eta(e) = W(e) / M(e), is the work per volume W up to a strain e
over the greatest stress M so far (Miltz & Gruenbaum 1981). Where it is greatest, the lattice has
absorbed most for the force that it transmits: the onset of densification (Avalle, Belingardi &
Montanini 2001; Li, Magkiriadis & Harrigan 2006).

The place of a maximum does not depend continuously on the curve. A lattice whose rows fold one
after another has several maxima of nearly the same height, and the least change of a force moves
the place from one to another (`packed_row`). A weighted mean over all strains of nearly the
greatest efficiency (`weights`) replaces that place,

    X = integral w x de / integral w de,    w(e) = max(0, eta(e) - (1 - BAND) max eta),

for x = energy, greatest force so far and strain. As BAND tends to 0, X tends to the value at the
maximum. For any BAND above 0 it depends continuously on the curve: eta changes by at most 2 e d / M
for a change of the stress by d, and rises with a slope of at most 1, so that the integral of w is
never below (BAND max eta)^2 / 2. Where two maxima exchange their ranks, X passes from one to the
other.
"""

import numpy as np

from sweep.array_types import Floats
from sweep.columns import SAME_EFFICIENCY

BAND = 0.2  # share of the greatest efficiency within which strains count


def efficiency(stress: Floats, work_density: Floats) -> Floats:
    """Energy-absorption efficiency: work density / greatest stress so far, (rows,)."""
    largest = np.maximum.accumulate(np.abs(stress))
    safe = np.where(largest > 0, largest, 1.0)
    return np.where(largest > 0, work_density / safe, 0.0)


def packed_row(eta: Floats) -> int | None:
    """The row of greatest efficiency (rows,); None if it is the first or the last one.

    In the last row the efficiency may still rise.
    """
    best = int(np.argmax(eta))
    return best if 0 < best < len(eta) - 1 else None


def near_maxima(eta: Floats) -> list[int]:
    """Rows of the maxima of nearly the greatest efficiency (rows,), except the first and the last
    row; of equal neighbours the last one counts.
    """
    inner, before, after = eta[1:-1], eta[:-2], eta[2:]
    near = inner >= (1.0 - SAME_EFFICIENCY) * eta.max()
    return [int(row) + 1 for row in np.flatnonzero(near & (inner >= before) & (inner > after))]


def weights(strain: Floats, eta: Floats) -> Floats:
    """Weights of the rows in a mean over strains of nearly the greatest efficiency; their sum is 1.

    strain, eta (efficiency): (rows,). All weight is on the last row if no energy was absorbed.
    """
    above = np.clip(eta - (1.0 - BAND) * eta.max(), 0.0, None)
    steps = np.diff(strain, prepend=strain[0]) + np.diff(strain, append=strain[-1])
    weight = above * steps  # trapezoidal rule
    return weight / weight.sum() if weight.sum() > 0.0 else last_row(len(strain))


def span(strain: Floats, eta: Floats) -> float:
    """Strain from the first to the last row of nearly the greatest efficiency."""
    near = strain[eta >= (1.0 - SAME_EFFICIENCY) * eta.max()]
    return float(near[-1] - near[0])


def last_row(count: int) -> Floats:
    """Weights (rows,) of the last of ``count`` rows alone."""
    return np.append(np.zeros(count - 1), 1.0)
