"""Stiffness of endless lattices of stout walls at small strain: joints against a solid of pixels.

python -m tests.studies.continuum.pixels prints the errors in three minutes. `lattices` needs walls
longer than their joints. Here the solid is the area that the walls cover, in plane stress, in
rectangles with a stiffness in proportion to their covered share; the bent sides of thin walls make
it too stiff, by an error that falls with the number of pixels.
"""

import sys

import numpy as np
from scipy.sparse import coo_matrix

from tests.studies.continuum.lattices import POISSON, Lattice
from tests.studies.continuum.press import factor

CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
POINTS = np.array([-1.0, 1.0]) / np.sqrt(3.0)  # of Gauss
FINER = 6  # points across a pixel, which count the covered area
STOUT = {  # t over the length of the shortest wall
    "circle": (0.2, 0.4, 0.5),
    "reentrant": (0.3, 0.4, 0.5),
    "kagome": (0.3, 0.4, 0.5),
    "triangle": (0.3, 0.4),
    "hex": (0.5, 0.7),
}
ACROSS = {"circle": 500, "reentrant": 400}  # pixels in the width of a period
USUAL = 160


def rectangle(a, b, poisson):
    """Stiffness (8, 8) of a rectangle of modulus 1 in plane stress, with incompatible modes."""
    sheared = 0.5 * (1.0 - poisson)
    elastic = np.array([[1.0, poisson, 0.0], [poisson, 1.0, 0.0], [0.0, 0.0, sheared]])
    signs, whole = 2.0 * CORNERS - 1.0, np.zeros((12, 12))
    for x in POINTS:
        for y in POINTS:
            dx = np.append(signs[:, 0] * (1.0 + signs[:, 1] * y) / 4.0, [-2.0 * x, 0.0]) * 2.0 / a
            dy = np.append(signs[:, 1] * (1.0 + signs[:, 0] * x) / 4.0, [0.0, -2.0 * y]) * 2.0 / b
            strain = np.zeros((3, 6, 2))
            strain[0, :, 0] = strain[2, :, 1] = dx
            strain[1, :, 1] = strain[2, :, 0] = dy
            strain = strain.reshape(3, 12)
            whole += strain.T @ elastic @ strain * a * b / 4.0
    whole /= 1.0 - poisson**2
    inner = whole[8:, 8:]
    return whole[:8, :8] - whole[:8, 8:] @ np.linalg.solve(inner, whole[8:, :8])


def covered(network, count):
    """Share of each pixel that walls cover, (ny, nx). count: (nx, ny). Ends of walls are round."""
    x, y = (
        (np.arange(n * FINER) + 0.5) * size / (n * FINER)
        for n, size in zip(count, network.period, strict=True)
    )
    inside = np.zeros((len(y), len(x)), np.bool_)
    for (one, other), t in zip(
        network.points[network.walls[: network.own]], network.wall_thickness, strict=False
    ):
        for image in np.ndindex(4, 4):
            start = one + (np.array(image) - 1) * network.period
            span = other - one
            low, high = np.sort([start, start + span], axis=0) + np.array([[-t], [t]])
            at = tuple(
                slice(*np.searchsorted(c, ends))
                for c, ends in ((y, (low[1], high[1])), (x, (low[0], high[0])))
            )
            from_x, from_y = x[at[1]] - start[0], y[at[0], None] - start[1]
            share = np.clip((from_x * span[0] + from_y * span[1]) / (span @ span), 0.0, 1.0)
            away = np.hypot(from_x - share * span[0], from_y - share * span[1])
            inside[at] |= away <= 0.5 * t
    return inside.reshape(count[1], FINER, count[0], FINER).mean(axis=(1, 3))


def solid(network, across, poisson):
    """Compliance for mean stresses xx, yy and xy, (3,), of the solid of modulus 1."""
    width, height = network.period
    count = across, round(across * height / width)
    a, b = width / count[0], height / count[1]
    share = covered(network, count)
    j, i = np.nonzero(share)
    share = share[j, i]
    node = (j[:, None] + CORNERS[:, 1]) % count[1] * count[0] + (
        i[:, None] + CORNERS[:, 0]
    ) % count[0]
    place = np.stack([2 * node, 2 * node + 1], axis=-1).reshape(-1, 8)
    one, size = rectangle(a, b, poisson), 2 * count[0] * count[1]
    entries = np.repeat(place, 8, axis=1).ravel(), np.tile(place, 8).ravel()
    matrix = coo_matrix(((share[:, None, None] * one).ravel(), entries), (size, size)).tocsc()
    corner = CORNERS * (a, b)
    mean = np.zeros((3, 4, 2))
    mean[0, :, 0], mean[1, :, 1] = corner.T
    mean[2] = 0.5 * corner[:, ::-1]
    mean = mean.reshape(3, 8)
    force = np.zeros((3, size))
    for k in range(3):
        np.add.at(force[k], place, -share[:, None] * (one @ mean[k]))
    free = np.unique(place)[2:]
    moved = np.zeros_like(force)
    moved[:, free] = factor(matrix[free][:, free]).solve(force[:, free].T.copy()).T
    local = moved[:, place] + mean[:, None]
    stiffness = np.einsum("aek,kl,bel,e->ab", local, one, local, share, optimize=True)
    return np.diag(np.linalg.inv(stiffness / (width * height)))


def main(out):
    """Print the errors."""
    out.write("| infill | t / L | joints / wall | in a run | beams to the centre |\n")
    out.write("|---|---|---|---|---|\n")
    for kind, slender in STOUT.items():
        for ratio in slender:
            lattice = Lattice(kind, 1.0, ratio)
            truth = solid(lattice.network, ACROSS.get(kind, USUAL), POISSON)
            cells = [kind, f"{ratio:g}", f"{lattice.filled():.2f}"]
            for joints in (lattice.of_scene(POISSON), None):
                errors = 100.0 * (truth / np.diag(lattice.yields(POISSON, joints)) - 1.0)
                cells.append(" / ".join(f"{error:+.1f}" for error in errors))
            out.write(f"| {' | '.join(cells)} |\n")
            out.flush()


if __name__ == "__main__":
    main(sys.stdout)
