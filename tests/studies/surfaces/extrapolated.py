"""Moduli of the solid wall in the limit of fine grids, from three grids, each twice as fine.

With the moduli m at n, 2 n and 4 n, the order is p = log2((m_n - m_2n) / (m_2n - m_4n)); the limit
takes the order of the method, 2, and is m_4n + (m_4n - m_2n) / 3. Its error is estimated by the
distance to the same limit from n and 2 n, which is larger where the order is near to 2.
"""

from typing import NamedTuple

import numpy as np

from tests.studies.surfaces import voxels, wall


class Limit(NamedTuple):
    """moduli, order, error (4,): see above, over `moduli.NAMES`; the error in units of the moduli.

    thickness: of the wall. rows: of each grid, n and its `voxels.Solid`.
    """

    moduli: np.ndarray
    order: np.ndarray
    error: np.ndarray
    thickness: float
    rows: list


def limit(share, n, poisson=0.3):
    """The `Limit` of a wall of this share of the period, on grids of n, 2 n and 4 n cubes."""
    thickness = wall.thickness_of(share)
    rows = [(k * n, voxels.solid(k * n, thickness, poisson)) for k in (1, 2, 4)]
    coarse, middle, fine = (solid.cubic.moduli for _, solid in rows)
    found, before = fine + (fine - middle) / 3.0, middle + (middle - coarse) / 3.0
    order = np.log2((coarse - middle) / (middle - fine))
    return Limit(found, order, np.abs(found - before) / found, thickness, rows)
