"""The curve of a crush between its rows, which may be far apart where the force hardly bends.

Forces are linear between two rows, d apart in displacement; the work is their integral:

    F(s) = F0 + s (F1 - F0),    W(s) = W0 + s (W1 - W0) - s (1 - s) (F1 - F0) d / 2

for s from 0 to 1, with W1 - W0 = (F0 + F1) d / 2. The greatest efficiency and the stroke up to an
allowed force rarely lie at a row.
"""

from collections.abc import Mapping

import numpy as np

from sweep.array_types import Floats

POINTS = 1024  # points, evenly spaced in strain, besides the rows
CURVE = ("strain", "top_displacement_m", "reaction_top_N", "reaction_bottom_N", "work_in_J")


def between_rows(loading: Mapping[str, Floats]) -> dict[str, Floats]:
    """The columns `CURVE` of a loading, whose strain rises, at its rows and evenly between them.

    A single row is returned unchanged, (rows,); else (points,).
    """
    columns = {name: loading[name] for name in CURVE}
    strain = columns["strain"]
    if len(strain) < 2:
        return columns
    points = np.union1d(strain, np.linspace(strain[0], strain[-1], POINTS))
    row = np.clip(np.searchsorted(strain, points, side="right") - 1, 0, len(strain) - 2)
    gap = np.diff(strain)[row]
    share = (points - strain[row]) / np.where(gap > 0.0, gap, 1.0)
    linear = {name: np.interp(points, strain, column) for name, column in columns.items()}
    bend = np.diff(columns["reaction_top_N"]) * np.diff(columns["top_displacement_m"])
    return linear | {"work_in_J": linear["work_in_J"] - 0.5 * share * (1.0 - share) * bend[row]}
