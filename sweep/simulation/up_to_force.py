"""Energy and stroke of a crush up to the point at which its force first exceeds a given force.

Between two rows the force is linear in the stroke, so that the stroke is linear in the force, and
the work in its square: W = W0 + (F^2 - F0^2) / (F1^2 - F0^2) (W1 - W0).
"""

import numpy as np

from sweep.array_types import Floats


def absorbed_until(force: float, transmitted: Floats, work: Floats) -> float:
    """Work (J) done until ``transmitted`` (rows,) first exceeds ``force`` (both N), interpolated.

    All of it if the force is never exceeded.
    """
    pushed = np.maximum(transmitted, 0.0)
    return _reached(force * force, pushed * pushed, work)


def stroke_until(force: float, transmitted: Floats, travel: Floats) -> float:
    """Stroke (m), of ``travel`` (rows,), until ``transmitted`` (rows,) first exceeds ``force``
    (both N).
    """
    return _reached(force, transmitted, travel)


def _reached(limit: float, rising: Floats, values: Floats) -> float:
    """The value at which ``rising`` (rows,) first exceeds ``limit``; the last one if it never does.

    It is interpolated between the rows.
    """
    over = np.flatnonzero(rising > limit)
    if len(over) == 0:
        return float(values[-1])
    k = over[0]
    if k == 0:
        return float(values[0])
    share = (limit - rising[k - 1]) / (rising[k] - rising[k - 1])
    return float(values[k - 1] + share * (values[k] - values[k - 1]))
