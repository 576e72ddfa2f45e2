"""A panel: specimens side by side in a rectangle."""

from typing import Any

import numpy as np


def specimens(area: float, width: Any, depth: Any) -> Any:
    """Whole number of specimens, outer ``width`` x ``depth`` (m), nearest to an ``area`` (m^2).

    Numbers, arrays or columns; the result is a float or floats.
    """
    return np.rint(area / (width * depth))
