"""Graphs of lattices of plates: the blocks, pairs and positions that a matrix of them has."""

import numpy as np

QUAD = [(a, b) for a in range(4) for b in range(a)]


def lattice_of_plates(cells, across, high, sizes=(5, 6)):
    """Return (sizes (nb,), pairs (k, 2), points (nb, 3)) of ``cells`` x ``cells`` square cells.

    across, high: quads along the width and the height of each wall. sizes: unknowns of a node
    inside a wall and of one of a joint line.
    """
    number, points, block, quads = {}, [], [], []

    def node(x, y, z):
        place = (x, y, z)
        if place not in number:
            number[place] = len(points)
            points.append((x / across, y / across, z / across))
            block.append(sizes[x % across == 0 and y % across == 0])
        return number[place]

    for row in range(cells + 1):
        for s in range(cells * across):
            for z in range(high):
                corners = [(s, z), (s + 1, z), (s + 1, z + 1), (s, z + 1)]
                quads.append([node(i, row * across, k) for i, k in corners])
                quads.append([node(row * across, i, k) for i, k in corners])
    pairs = np.array([(quad[a], quad[b]) for quad in quads for a, b in QUAD])
    return np.array(block), pairs, np.array(points)


def folded(points, height):
    """The positions (nb, 3) when walls wave to alternate sides, a period of two cells, and the
    lattice is ``height`` times as high.
    """
    x, y, z = points.T
    wave = 0.45 * np.sin(np.pi * z)
    along_x, along_y = y % 1.0 == 0.0, x % 1.0 == 0.0
    dx, dy = wave * np.sin(np.pi * y) * along_y, wave * np.sin(np.pi * x) * along_x
    return np.column_stack([x + dx, y + dy, height * z])


def near_pairs(points, distance):
    """Pairs (k, 2) of points that are less than ``distance`` apart."""
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    return np.argwhere(np.triu(apart < distance, 1))
