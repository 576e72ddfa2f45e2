"""The matrix of a step as a library is given it: free coordinates, none condensed, sparse."""

import numpy as np
from scipy import sparse

from kernels.linear.block_matrix import HELD


def _motions(walls, n):
    """Motion (2 m + 2 w, n) of every element vector and of the rotation of every arm's joint."""
    m, arms = len(walls.edges), walls.rotation.size
    columns = (2 * walls.edges[:, None, :] + np.array([[0], [1]])).ravel()  # x and y of both ends
    ends = np.tile([-1.0, 1.0], 2 * m), (np.repeat(np.arange(2 * m), 2), columns)
    turns = np.ones(arms), (np.arange(arms), walls.rotation)
    parts = sparse.csr_array(ends, shape=(2 * m, n)), sparse.csr_array(turns, shape=(arms, n))
    return sparse.vstack(parts, format="csr")


def _half(walls, stiffness):
    """Second derivatives in these motions, those on the diagonal halved: (row, column, value)."""
    m, arms = len(walls.edges), walls.rotation.size
    x, phi = 2 * np.arange(m), 2 * m + np.arange(arms)
    inside = np.setdiff1d(np.arange(m), walls.start[1:] - 1)
    yield x, x, 0.5 * stiffness.own[0]
    yield x, x + 1, stiffness.own[1]
    yield x + 1, x + 1, 0.5 * stiffness.own[2]
    for c, following in enumerate(stiffness.next):
        yield x[inside] + c // 2, x[inside] + 2 + c % 2, following[inside]
    for c in range(2):
        yield x[walls.arm_element] + c, phi, stiffness.arm[c]
    yield phi, phi, 0.5 * stiffness.arm[2]
    yield phi[::2], phi[1::2], stiffness.twist


def reduction(layout):
    """Matrix (n, free) from what is solved for to coordinates: tied ones go with their leader."""
    leader = layout.leader
    kept = np.setdiff1d(leader, [HELD, layout.driven])
    moving = np.flatnonzero(np.isin(leader, kept))
    entries = np.ones(moving.size), (moving, np.searchsorted(kept, leader[moving]))
    return sparse.csr_array(entries, shape=(leader.size, kept.size))


def assembled(terms, stiffness):
    """Hessian (free, free) of the walls; every place where elements couple holds an entry."""
    motions = _motions(terms.walls, terms.coordinates.mass.size) @ reduction(terms.layout)
    rows, columns, values = map(np.concatenate, zip(*_half(terms.walls, stiffness), strict=True))
    size = motions.shape[0]
    half = sparse.coo_array((values, (rows, columns)), shape=(size, size)).tocsr()
    hessian = motions.T @ (half + half.T) @ motions
    half.data[:] = 1.0
    full = (abs(motions).T @ (half + half.T) @ abs(motions)).tocsc()  # product: zeros are dropped
    full.sort_indices()
    columns = np.repeat(np.arange(full.shape[1]), np.diff(full.indptr))
    full.data = hessian.tocsr()[full.indices, columns]
    return full
