"""The matrix of a step as a library is given it: free coordinates, none condensed, sparse."""

import numpy as np
from scipy import sparse

from kernels.linear.condensed.block_matrix import HELD


def _parts(walls, stiffness, n):
    """Motions (4 m, n) of chords and rotations of all elements, and their Hessian (4 m, 4 m)."""
    m, dofs = len(walls.edges), walls.dofs
    rows = 4 * np.arange(m)[:, None] + np.array([0, 1, 2, 0, 1, 3])
    signs = np.tile([-1.0, -1.0, 1.0, 1.0, 1.0, 1.0], m)
    motions = sparse.csr_array((signs, (rows.ravel(), dofs.ravel())), shape=(4 * m, n))
    (xx, xy, yy), (ax, ay, bx, by), (aa, ab, bb) = stiffness
    full = [[xx, xy, ax, bx], [xy, yy, ay, by], [ax, ay, aa, ab], [bx, by, ab, bb]]
    place = 4 * np.arange(m)[:, None, None] + np.arange(4)[:, None] + np.zeros(4, np.int64)
    other = 4 * np.arange(m)[:, None, None] + np.arange(4) + np.zeros((4, 1), np.int64)
    values = np.array(full).transpose(2, 0, 1).ravel()
    return motions, sparse.csr_array((values, (place.ravel(), other.ravel())), shape=2 * (4 * m,))


def reduction(layout):
    """Matrix (n, free) from what is solved for to coordinates: tied ones go with their leader."""
    leader = layout.leader
    kept = np.setdiff1d(leader, [HELD, layout.driven])
    moving = np.flatnonzero(np.isin(leader, kept))
    entries = np.ones(moving.size), (moving, np.searchsorted(kept, leader[moving]))
    return sparse.csr_array(entries, shape=(leader.size, kept.size))


def assembled(terms, stiffness):
    """Hessian (free, free) of the walls; every place where elements couple holds an entry."""
    motions, own = _parts(terms.walls, stiffness, terms.coordinates.mass.size)
    motions = motions @ reduction(terms.layout)
    hessian, pattern = motions.T @ own @ motions, own.copy()
    pattern.data[:] = 1.0
    full = (abs(motions).T @ pattern @ abs(motions)).tocsc()  # product: zeros are dropped
    full.sort_indices()
    columns = np.repeat(np.arange(full.shape[1]), np.diff(full.indptr))
    full.data = hessian.tocsr()[full.indices, columns]
    return full
