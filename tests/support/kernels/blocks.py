"""Matrices of blocks for tests: their patterns, and how they are filled."""

import numpy as np

from kernels.linear.condensed import block_matrix, periodic_images

NB = 12


def filled(joined):
    """Pattern (nb, nb) with the fill of eliminating the blocks one after the other."""
    joined = joined | np.eye(len(joined), dtype=bool)
    for j in range(len(joined)):
        behind = j + 1 + np.flatnonzero(joined[j + 1 :, j])
        joined[np.ix_(behind, behind)] = True
    return joined


def random_pattern(rng, nb=NB):
    """Symmetric pattern of ``nb`` blocks, closed under elimination."""
    joined = rng.uniform(size=(nb, nb)) < 1.5 / nb
    return filled(joined | joined.T)


def shaped(joined, home=None, ratio=None):
    """Zero matrix with the blocks of a closed pattern; by default every slot is a coordinate."""
    nb = len(joined)
    below = [j + 1 + np.flatnonzero(joined[j + 1 :, j]) for j in range(nb)]
    start = np.cumsum([0, *map(len, below)])
    home = np.arange(3 * nb) if home is None else home
    ratio = np.ones(home.size) if ratio is None else ratio
    return block_matrix.zero_matrix(home, start, np.concatenate(below), ratio, periodic_images.NONE)


def put(matrix, full, room=None):
    """Add the lower half of an (n, n) array where there is ``room``, (n, n) of bool."""
    for i in range(len(full)):
        for j in range(i + 1):
            if room is None or room[i, j]:
                block_matrix.add(matrix, i, j, full[i, j])


def by_entry(joined):
    """Pattern of the entries of a pattern of blocks."""
    return np.kron(joined, np.ones((3, 3), dtype=bool))


def reduction_to(home, nb):
    """Matrix (n, 3 nb) of ones where a coordinate has its home."""
    return (np.asarray(home)[:, None] == np.arange(3 * nb)).astype(float)


def column(slender, compression, angle):
    """Hessian of a clamped column of discrete hinges, and the pattern of its blocks.

    Axial stiffness 1; compression as a share of the buckling load.
    """
    n = 12
    first = np.eye(n) - np.eye(n, k=-1)
    second = np.diff(np.vstack([np.zeros(n), first]), axis=0)
    bending = (n / slender) ** 2 / 12.0 * second.T @ second
    buckling = np.linalg.eigvals(np.linalg.solve(first.T @ first, bending)).real.min()
    across = bending - compression * buckling * first.T @ first
    along, normal = (
        np.array([np.cos(angle), np.sin(angle)]),
        np.array([-np.sin(angle), np.cos(angle)]),
    )
    full = np.zeros((n, 3, n, 3))
    full[:, :2, :, :2] += np.einsum("ij,r,s->irjs", first.T @ first, along, along)
    full[:, :2, :, :2] += np.einsum("ij,r,s->irjs", across, normal, normal)
    full[:, 2, :, 2] = np.eye(n)
    near = np.abs(np.subtract.outer(np.arange(n), np.arange(n))) < 3
    return full.reshape(3 * n, 3 * n), filled(near)
