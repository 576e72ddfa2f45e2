"""Energy or stroke of a crush up to the point at which its force first exceeds a given force."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def absorbed_until(force: float, transmitted: Floats, work: Floats) -> float:
    """Work (J) done until ``transmitted`` (rows,) first exceeds ``force`` (both N), interpolated.

    All of it if the force is never exceeded. The same for the stroke (m) in place of the work.
    """
    over = np.flatnonzero(transmitted > force)
    if len(over) == 0:
        return float(work[-1])
    k = over[0]
    if k == 0:
        return float(work[0])
    share = (force - transmitted[k - 1]) / (transmitted[k] - transmitted[k - 1])
    return float(work[k - 1] + share * (work[k] - work[k - 1]))
