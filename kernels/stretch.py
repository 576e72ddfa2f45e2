"""Stretching of straight elements: E_s = sum A l0 W(e), nominal strain e = l / l0 - 1."""

from typing import NamedTuple

import numpy as np

from kernels.jit import jit
from kernels.law import uniaxial
from kernels.sparse import add_block


class Stretch(NamedTuple):
    """Elements: edges (m, 2) nodes, l0 (m,) rest length in m, area (m,) cross-section in m^2."""

    edges: np.ndarray
    l0: np.ndarray
    area: np.ndarray


@jit
def direction(x, i, j):
    """Return unit vector and length of the line from node ``i`` to node ``j``."""
    nx = x[2 * j] - x[2 * i]
    ny = x[2 * j + 1] - x[2 * i + 1]
    length = np.sqrt(nx * nx + ny * ny)
    return nx / length, ny / length, length


@jit
def pull(g, i, j, nx, ny, tension):
    """Add the gradient of an energy with derivative ``tension`` in the length of edge i-j."""
    g[2 * i] -= tension * nx
    g[2 * i + 1] -= tension * ny
    g[2 * j] += tension * nx
    g[2 * j + 1] += tension * ny


@jit
def stiffen(matrix, i, j, nx, ny, along, across):
    """Add along n n^T + across (I - n n^T) between nodes ``i`` and ``j``."""
    xx = across + (along - across) * nx * nx
    xy = (along - across) * nx * ny
    yy = across + (along - across) * ny * ny
    add_block(matrix, 2 * i, 2 * i, xx, xy, xy, yy)
    add_block(matrix, 2 * j, 2 * j, xx, xy, xy, yy)
    add_block(matrix, 2 * i, 2 * j, -xx, -xy, -xy, -yy)


@jit
def energy(x, stretch, law):
    """Return E_s in J."""
    total = 0.0
    for k in range(stretch.l0.size):
        _, _, length = direction(x, stretch.edges[k, 0], stretch.edges[k, 1])
        density, _, _ = uniaxial(law, length / stretch.l0[k] - 1.0)
        total += stretch.area[k] * stretch.l0[k] * density
    return total


@jit
def gradient(x, stretch, law, g):
    """Add dE_s/dx to ``g``: A sigma(e) along the element."""
    for k in range(stretch.l0.size):
        i, j = stretch.edges[k, 0], stretch.edges[k, 1]
        nx, ny, length = direction(x, i, j)
        _, stress, _ = uniaxial(law, length / stretch.l0[k] - 1.0)
        pull(g, i, j, nx, ny, stretch.area[k] * stress)


@jit
def hessian(x, stretch, law, matrix, projected):
    """Add d2E_s/dx2: A sigma'(e) / l0 along, A sigma(e) / l across the element.

    ``projected`` clips both at zero, which makes every element positive semi-definite.
    """
    for k in range(stretch.l0.size):
        i, j = stretch.edges[k, 0], stretch.edges[k, 1]
        nx, ny, length = direction(x, i, j)
        _, stress, tangent = uniaxial(law, length / stretch.l0[k] - 1.0)
        along = stretch.area[k] * tangent / stretch.l0[k]
        across = stretch.area[k] * stress / length
        if projected:
            along, across = max(along, 0.0), max(across, 0.0)
        stiffen(matrix, i, j, nx, ny, along, across)
