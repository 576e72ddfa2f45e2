"""Stiffness of one period of a gyroid of shells, by a linear solve at rest.

Corners of quads move by u = e x + v under a mean strain e, with v and the rotations periodic; the
rotation about the normal, which no quad resists, is held. With the Hessian K of the elements over
corners, P from the unknowns to corners and D from strains to corners, the stiffness is

    C = (D' K D - D' K P (P' K P)^(-1) P' K D) / L^3,   L = 1
"""

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.linalg import splu

from tests.studies.surfaces.moduli import tensor
from tests.support.kernels import sheets
from tests.support.kernels.shells import element_hessians, smooth


def structure(net, thickness, modulus, poisson):
    """The shells of a `period.Period`, with a node for each image of a node; and the original of
    each node.
    """
    key = np.dstack([net.quads, net.shift]).reshape(-1, 4)
    images, quads = np.unique(key, axis=0, return_inverse=True)
    node = images[:, 0]
    points = net.points[node] + images[:, 1:]
    body = smooth(points, net.normals[node], quads.reshape(-1, 4), thickness, modulus, poisson)
    return body, node


def stiffness(net, thickness, modulus=1.0, poisson=0.3):
    """C (6, 6) of a sheet of this thickness, in units of the modulus, and the area of its quads."""
    body, node = structure(net, thickness, modulus, poisson)
    quads = body.walls.quads
    hessians = element_hessians(body, body.rest, sheets.hooke(modulus, poisson))
    strained = np.zeros((len(quads), 4, 6, 6))
    for k, strain in enumerate(np.eye(6)):
        strained[:, :, :3, k] = body.points[quads] @ tensor(strain)
    strained = strained.reshape(-1, 24, 6)
    pushed = hessians @ strained
    unknown = (6 * node[quads][..., None] + np.arange(6)).reshape(-1, 24)
    size = 6 * len(net.points)
    at = np.repeat(unknown, 24, axis=1).ravel(), np.tile(unknown, (1, 24)).ravel()
    matrix = csr_array((hessians.ravel(), at), (size, size))
    force = [np.bincount(unknown.ravel(), pushed[..., k].ravel(), size) for k in range(6)]
    force = np.stack(force, axis=1)
    free = np.ones((len(net.points), 6), bool)
    free[:, 5], free[0, :3] = False, False  # about the normal; translations of the whole
    free = np.flatnonzero(free)
    move = splu(matrix[free][:, free].tocsc()).solve(force[free])
    uniform = np.einsum("mik,mil->kl", strained, pushed)
    return uniform - force[free].T @ move, body.walls.area.sum()
