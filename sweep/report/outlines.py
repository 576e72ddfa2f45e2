"""Outlines of a striker and of ribs in the frames of a case, for pictures and the page."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from sweep.numbers import in_unit


def outlines(frames: Mapping[str, Any]) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Outlines (v, 2) below and above, x and y in mm, y above the platen that they replace.

    Both ribs have outlines of the same length. Empty if platens are flat.
    """
    none = np.empty((0, 2))
    below, above = (in_unit(frames.get(name, none), "mm") for name in ("base_m", "striker_m"))
    return np.split(below, 2) if len(below) else [], [above] if len(above) else []
