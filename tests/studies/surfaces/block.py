"""Stiffness of a block of a gyroid within perimeters, of shells and of bricks of the solid.

The block is pressed along z between platens that hold its ends, of perimeters the middle. The
period and the modulus are 1. The solid is all within half of the thickness of perimeters and of the
sheet, which ends at the middle of these. Stiffness is force over displacement.
"""

from itertools import product

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.linalg import splu

from kernels.plates.layout import PER_NODE
from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.panel import net_of_block
from sweep.scene.plates.coordinates import Numbering, at_rest, leaders
from sweep.scene.plates.sheet import build_sheet
from tests.studies.surfaces import voxels, wall
from tests.support.kernels import sheets
from tests.support.kernels.shells import Structure, element_hessians

CORNER = np.array(SHEETS["gyroid"].corner)


def of_shells(quads, side, sheet, perimeters, walled, poisson):
    """Stiffness of a cube of shells; quads: a period; walled: axes across which it has perimeters;
    sheet, perimeters: thicknesses.
    """
    net = net_of_block("gyroid", 1.0, (side,) * 3, walled, quads)
    mesh = build_sheet(net, np.where(net.wall < 0, sheet, perimeters))
    x, shear = at_rest(mesh, "clamped"), 5.0 / 12.0 / (1.0 + poisson)
    body = Structure(mesh.rest, mesh.frames, mesh.shells(x, (shear, shear)))
    hessians = element_hessians(body, x, sheets.hooke(1.0, poisson))
    of = (PER_NODE * mesh.quads[..., None] + np.arange(PER_NODE)).reshape(-1, 24)
    at = np.repeat(of, 24, axis=1).ravel(), np.tile(of, (1, 24)).ravel()
    numbering = Numbering(mesh.n_nodes)
    matrix = csr_array((hessians.ravel(), at), (numbering.low, numbering.low))
    leader = leaders(mesh, "clamped")[: numbering.low]
    free = np.flatnonzero(leader == np.arange(numbering.low))
    top = numbering.position(mesh.top, 2)
    return _condensed(matrix, free, top, lambda inner, force: splu(inner.tocsc()).solve(force))


def of_bricks(n, side, sheet, perimeters, walled, poisson):
    """The same for the solid, of cubes of 1 / n, on whose grid its faces lie."""
    margin = np.zeros(3)
    margin[[axis for axis in walled if axis != 2]] = 0.5 * perimeters
    size = np.rint((side + 2.0 * margin) * n).astype(int)
    at = np.indices(size).reshape(3, -1).T
    inner = (np.array(list(product(range(voxels.PARTS), repeat=3))) + 0.5) / voxels.PARTS
    points = (at[:, None] + inner) / n - margin
    shares = _share(points.reshape(-1, 3), n, side, sheet, perimeters, walled)
    shares = shares.reshape(len(at), -1)
    at, shares = at[shares.any(axis=1)], shares[shares.any(axis=1)]
    bricks = (shares @ voxels.brick_parts(poisson).reshape(voxels.PARTS**3, -1)) / n
    corner = at[:, None] + voxels.CORNERS
    used, number = np.unique(corner.reshape(-1, 3), axis=0, return_inverse=True)
    of = (3 * number.reshape(-1, 8)[..., None] + np.arange(3)).reshape(-1, 24)
    rows = np.repeat(of, 24, axis=1).ravel(), np.tile(of, (1, 24)).ravel()
    matrix = csr_array((bricks.ravel(), rows), (3 * len(used),) * 2)
    ends = (used[:, 2] == 0) | (used[:, 2] == size[2])
    free = np.flatnonzero(np.repeat(~ends, 3))
    top = 3 * np.flatnonzero(used[:, 2] == size[2]) + 2
    return _condensed(matrix, free, top, voxels.solved)


def limit(n, *block):
    """The stiffness of the solid in the limit of fine grids, of order 2, from cubes of 1 / n and of
    half that size.
    """
    coarse, fine = (of_bricks(k * n, *block) for k in (1, 2))
    return fine + (fine - coarse) / 3.0


def _share(points, n, side, sheet, perimeters, walled):
    """The solid share of parts of cubes with these centres, (k,)."""
    inside = np.all((points > 0.0) & (points < side), axis=1)
    away = np.where(inside, wall.distance(points + CORNER) - 0.5 * sheet, np.inf)
    for axis in walled:
        beside = np.minimum(np.abs(points[:, axis]), np.abs(points[:, axis] - side))
        away = np.minimum(away, beside - 0.5 * perimeters)
    return np.clip(0.5 - away * n * voxels.PARTS, 0.0, 1.0)


def _condensed(matrix, free, top, solve):
    """Force over displacement of the coordinates ``top`` if only the ``free`` ones may move."""
    moved = np.zeros(matrix.shape[0])
    moved[top] = 1.0
    force = matrix @ moved
    moved[free] = solve(matrix[free][:, free], -force[free])
    return float(moved[top] @ (matrix @ moved)[top])
