"""Lattices that are pressed along their cells."""

import numpy as np
from scipy.spatial import cKDTree

from sweep.config.case import Case
from sweep.design.infill import families
from sweep.design.network import Network

FAMILIES = families()
BOX, T = 12e-3, 0.3e-3


def along(platen="glued", **lattice):
    """A case of 3 x 3 cells in a cube of 12 mm with walls of 0.3 mm, or of another ``lattice``."""
    box = {"width": BOX, "height": BOX, "depth": BOX, "wall_thickness": T}
    loading = dict(direction="out_of_plane", platen=platen)
    return Case.of(lattice=box | lattice, loading=loading)


def network(points, walls, thickness=0.3e-3):
    """A network of these points (mm) and walls, of one thickness in m or one for each wall."""
    none = np.empty(0, np.int64)
    each = np.broadcast_to(np.asarray(thickness, float), len(walls))
    return Network(1e-3 * np.array(points, float), np.array(walls), each, none, none)


def repeated(single, double, x, period):
    """The shape ``x`` of a scene of one period, in the coordinates of a scene of two."""
    y, moves = double.x_rest.copy(), (x - single.x_rest)[:-2].reshape(-1, 6)
    own, tree = single.mesh.own, cKDTree(single.mesh.rest[single.mesh.own])
    shifts = [np.append([i, j] * period, 0.0) for i in range(-3, 4) for j in range(-3, 4)]
    distance, near = np.array([tree.query(double.mesh.rest + shift) for shift in shifts]).swapaxes(
        0, 1
    )
    best = distance.argmin(axis=0), np.arange(len(double.mesh.rest))
    assert distance[best].max() < 1e-9
    y[:-2].reshape(-1, 6)[:] += moves[own][near[best].astype(int)]
    y[-2:] = x[-2:]
    return y
