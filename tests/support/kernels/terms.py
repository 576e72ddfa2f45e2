"""Energies with dense derivatives, for tests of kernels, and these derivatives against differences.

The Hessian of walls is put together here from the motions of their elements, apart from `condense`
and `system`, which are compared with it.
"""

import numpy as np

from kernels.geometry import near_pairs
from kernels.laws.law import Memory
from kernels.laws.relaxation import Pace
from kernels.linear.condensed import block_matrix, periodic_images
from kernels.linear.condensed.block_matrix import Blocks
from kernels.planar.problem import PlanarScene
from kernels.solve.integrators import Ahead
from kernels.terms import bend, contact, damping, elements, stretch

NO_PACE = Pace(np.empty(0), np.empty(0), np.empty((0, 3)), np.ones(1))
NO_MEMORY = Memory(np.empty((0, 0)), np.empty((0, 2)), NO_PACE)
NO_STRETCH = stretch.Stretch(np.empty(0), np.empty(0), np.empty((2, 0)), True)


class Term:
    """An energy of the coordinates x (n,).

    ``slope(x, g)`` adds its gradient to g and returns it; ``second(x)``: Hessian (n, n);
    ``projected(x)``: the same without negative eigenvalues of any element, for terms that have it.
    """

    def __init__(self, slope, second, projected=None):
        self.slope, self.second, self.projected = slope, second, projected

    def energy_gradient(self, x: np.ndarray) -> tuple[float, np.ndarray]:
        """Energy and gradient (n,) at ``x``."""
        g = np.zeros_like(x)
        return self.slope(x, g), g

    def energy(self, x: np.ndarray) -> float:
        """Energy at ``x``."""
        return self.energy_gradient(x)[0]

    def gradient(self, x: np.ndarray) -> np.ndarray:
        """Gradient (n,) at ``x``."""
        return self.energy_gradient(x)[1]

    def hessian(self, x: np.ndarray, projected: bool = False) -> np.ndarray:
        """Hessian (n, n) at ``x``, exact or ``projected``."""
        return self.projected(x) if projected else self.second(x)


def difference(one: Term, other: Term, x: np.ndarray) -> float:
    """Largest difference of two terms at ``x``, over the largest entry of the same kind."""
    pairs = [(getattr(one, k)(x), getattr(other, k)(x)) for k in ("energy", "gradient", "hessian")]
    return max(np.abs(found - other).max() / np.abs(other).max() for found, other in pairs)


def room(
    walls: elements.Walls,
) -> tuple[elements.Shape, elements.Resultants, elements.Stiffness]:
    """Zero shape, resultants and stiffness of ``walls``."""
    m = len(walls.edges)
    return (
        elements.Shape(*map(np.zeros, ((2, m), m, (2, m), (4, m)))),
        elements.Resultants(*map(np.zeros, ((3, m), (6, m)))),
        elements.Stiffness(*map(np.zeros, ((3, m), (4, m), (3, m)))),
    )


def motions(walls: elements.Walls, n: int) -> np.ndarray:
    """Motion (m, 4, n) of the chord of every element and of the rotations of its two ends."""
    moved = np.zeros((len(walls.edges), 4, n))
    for k, (a, b, phi, c, d, psi) in enumerate(walls.dofs):
        moved[k, [0, 1, 0, 1], [c, d, a, b]] = 1.0, 1.0, -1.0, -1.0
        moved[k, [2, 3], [phi, psi]] = 1.0
    return moved


def matrices(stiffness: elements.Stiffness) -> np.ndarray:
    """Symmetric matrices (m, 4, 4) of every element: chord x, y, rotations of its two ends."""
    (xx, xy, yy), (ax, ay, bx, by), (aa, ab, bb) = stiffness
    rows = [[xx, xy, ax, bx], [xy, yy, ay, by], [ax, ay, aa, ab], [bx, by, ab, bb]]
    return np.array(rows).transpose(2, 0, 1)


def assembled(walls: elements.Walls, stiffness: elements.Stiffness, n: int) -> np.ndarray:
    """Hessian (n, n) of walls from the Hessians of their elements."""
    moved = motions(walls, n)
    pulled = matrices(stiffness) @ moved
    return moved.reshape(-1, n).T @ pulled.reshape(-1, n)


def of_walls(walls: elements.Walls, write, x0=None) -> Term:
    """Term of walls that ``write(shape, resultants, projected)`` writes.

    Turns count from x0 (or x).
    """

    def found(x, projected):
        shape, resultants, stiffness = room(walls)
        frame = np.full((len(walls.edges), 3), np.inf)
        elements.renew_frame(x if x0 is None else x0, walls, frame)
        elements.measure(x, walls, frame, shape)
        value = write(shape, resultants, projected)
        elements.add(resultants, True, projected, shape, stiffness)
        return value, shape, stiffness

    def slope(x, g):
        value, shape, _ = found(x, False)
        elements.gather(walls, shape, g)
        return value

    def hessian(x, projected=False):
        return assembled(walls, found(x, projected)[2], x.size)

    return Term(slope, hessian, lambda x: hessian(x, True))


def bending_of(walls: elements.Walls, bending: bend.Bend, x0=None, along=NO_STRETCH) -> Term:
    """Bending; turns count from x0 (or x). along: stretching data of the sections."""

    def write(shape, resultants, projected):
        return bend.evaluate(bending, along, NO_MEMORY, shape, resultants, projected)

    return of_walls(walls, write, x0)


def nowhere(n: int) -> Ahead:
    """Rates of ``n`` coordinates are measured from where a step starts."""
    return Ahead(0.0, 0.0, np.zeros(n), np.zeros(n))


def before_of(terms: PlanarScene, x0: np.ndarray) -> damping.Before:
    """The start of a step from x0."""
    walls = terms.walls
    shape, resultants, stiffness = room(walls)
    m = len(walls.edges)
    before = damping.Before(np.full((m, 3), np.inf), shape, np.zeros(m), stiffness)
    where, place = nowhere(x0.size), np.zeros_like(x0)
    damping.prepare(x0, terms, NO_MEMORY, before, where, place, room(walls)[0], resultants)
    return before


def damping_of(terms: PlanarScene, x0: np.ndarray, dt: float) -> Term:
    """Damping of a step of ``dt`` from x0."""
    walls, before = terms.walls, before_of(terms, x0)

    def found(x, g):
        shape, resultants, stiffness = room(walls)
        elements.measure(x, walls, before.frame, shape)
        value = damping.evaluate(x - x0, terms, before, dt, shape, resultants, stiffness, g)
        return value, stiffness

    def second(x):
        _, stiffness = found(x, np.zeros_like(x))
        diagonal = np.zeros_like(x)
        damping.hessian(terms, dt, diagonal)
        return assembled(walls, stiffness, x.size) + np.diag(diagonal)

    return Term(lambda x, g: found(x, g)[0], second)


def full_matrix(n: int) -> Blocks:
    """Matrix with room for every pair of ``n`` coordinates, two of them in a block."""
    c = np.arange(n)
    nb = (n + 1) // 2
    start = np.cumsum([0, *range(nb - 1, -1, -1)])
    row = np.concatenate([np.arange(j + 1, nb) for j in range(nb)])
    return block_matrix.zero_matrix(
        3 * (c // 2) + c % 2, start, row, np.ones(n), periodic_images.NONE
    )


def by_home(matrix: Blocks) -> np.ndarray:
    """Symmetric (3 nb, 3 nb) array of the blocks of a matrix."""
    nb = matrix.start.size - 1
    cells = matrix.values.reshape(-1, 3, block_matrix.STRIDE)[:, :, :3].transpose(0, 2, 1)
    full = np.zeros((nb, nb, 3, 3))
    full[np.arange(nb), np.arange(nb)] = cells[:nb]
    full[matrix.row, np.repeat(np.arange(nb), np.diff(matrix.start))] = cells[nb:]
    lower = np.tril(full.transpose(0, 2, 1, 3).reshape(3 * nb, 3 * nb))
    return lower + np.tril(lower, -1).T


def dense(matrix: Blocks) -> np.ndarray:
    """Symmetric (n, n) array by coordinate of a matrix in which each has a home of its own."""
    return by_home(matrix)[np.ix_(matrix.home, matrix.home)] + np.diag(matrix.diagonal)


def of_points(slope, add) -> Term:
    """Term with ``slope(x, g)`` as in `Term`, whose Hessian ``add(x, matrix)`` adds."""

    def second(x):
        matrix = full_matrix(x.size)
        add(x, matrix)
        assert matrix.missing[0] == 0
        return dense(matrix)

    return Term(slope, second)


def touch_of(contacts: contact.Contact, listed: near_pairs.Pairs, anchor: np.ndarray) -> Term:
    """Contact with the pairs that were listed at ``anchor`` (n,)."""
    touching = contact.no_contacts(listed)

    def slope(x, g):
        drift = near_pairs.farthest(x, anchor, contacts.tributary.size)
        return contact.evaluate(x, contacts, listed, drift, touching, g)

    def add(x, matrix):
        slope(x, np.zeros_like(x))
        contact.hessian(x, contacts, listed, touching, matrix)

    return of_points(slope, add)


def differences(function, x: np.ndarray, step: np.ndarray) -> np.ndarray:
    """Fourth-order central differences of ``function`` at ``x`` in steps of each coordinate."""
    rows = []
    for i in range(x.size):
        e = np.zeros_like(x)
        e[i] = step[i]
        close = function(x + e) - function(x - e)
        far = function(x + 2 * e) - function(x - 2 * e)
        rows.append((8 * close - far) / (12 * step[i]))
    return np.array(rows)


def law_errors(respond, strain, step: float) -> tuple[float, float]:
    """Largest errors of slopes and second derivatives of a law against differences.

    respond: returns energy, slopes and the upper triangle of second derivatives, row by row, at the
    components of a ``strain``.
    """
    at = np.atleast_1d(strain).astype(float)
    _, slopes, second = respond(*at)
    change = differences(lambda x: np.append(*respond(*x)[:2]), at, np.full(at.size, step))
    by_slopes = change[:, 1:][np.triu_indices(at.size)]
    return np.abs(change[:, 0] - slopes).max(), np.abs(by_slopes - second).max()


def derivative_error(term, x: np.ndarray, unit=1.0, step: float = 1e-3) -> float:
    """Largest error of gradient and exact Hessian against differences, relative to their size.

    unit: size of a coordinate, a number or (n,); step: of the differences, in that unit.
    """
    unit = np.broadcast_to(unit, x.shape)
    slope = term.gradient(x) * unit
    curvature = term.hessian(x) * np.outer(unit, unit)
    change = differences(lambda x: np.append(*term.energy_gradient(x)), x, step * unit)
    by_energy, by_slope = change[:, 0] * unit, change[:, 1:] * np.outer(unit, unit)
    stiffest, steepest = np.abs(curvature).max(), np.abs(slope).max()
    in_slope = np.abs(slope - by_energy).max() / (steepest + step * stiffest or 1.0)
    in_curvature = np.abs(curvature - by_slope).max() / (stiffest or steepest or 1.0)
    return max(in_slope, in_curvature)


def least_share(term, x: np.ndarray, unit=1.0) -> float:
    """Smallest eigenvalue of the projected Hessian, of the exact one of terms without it, as a
    share of the largest one.
    """
    unit = np.broadcast_to(unit, x.shape)
    values = np.linalg.eigvalsh(term.hessian(x, term.projected is not None) * np.outer(unit, unit))
    return values[0] / np.abs(values).max()
