"""Triangulated sheets in space and their contact, for tests of kernels."""

import itertools

import numpy as np

from kernels.geometry.space import crossing
from kernels.geometry.space.vectors import SIZE
from kernels.plates.contacts import contact, pairs
from kernels.plates.contacts.touching import no_contacts
from tests.support.kernels.terms import Term

NOBODY = np.empty(0, np.int64), np.empty(0)
FAR_APART = 100.0


class Sheet:
    """A rectangular grid of quads, each cut into two triangles along alternate diagonals.

    points (n, 3), triangles (k, 3), area (n,): a quarter of its quads for each node.
    """

    def __init__(self, across: int, along: int, width=1.0, height=1.0, origin=(0.0, 0.0, 0.0)):
        s, z = np.linspace(0, width, across + 1), np.linspace(0, height, along + 1)
        n = (across + 1) * (along + 1)
        self.points = np.array([(a, b, 0.0) for b in z for a in s]) + np.array(origin)
        self.area, found = np.zeros(n), []
        for i, j in itertools.product(range(across), range(along)):
            a = j * (across + 1) + i
            b, c, d = a + 1, a + across + 2, a + across + 1
            self.area[[a, b, c, d]] += 0.25 * width * height / (across * along)
            found += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
        self.triangles = np.array(found)


def united(*sheets: Sheet):
    """Points, triangles and areas of several sheets."""
    first = np.cumsum([0] + [len(s.points) for s in sheets])
    triangles = [s.triangles + k for s, k in zip(sheets, first, strict=False)]
    return (
        np.concatenate([s.points for s in sheets]),
        np.concatenate(triangles),
        np.concatenate([s.area for s in sheets]),
    )


def placed(points, low=-1e3, high=1e3):
    """Coordinates of nodes at ``points`` with zero rotations, and of two platens."""
    x = np.zeros((len(points), SIZE))
    x[:, :3] = points
    return np.concatenate([x.ravel(), [low, high]])


def positions(x):
    """Positions (n, 3) in coordinates ``x``."""
    return x[:-2].reshape(-1, SIZE)[:, :3]


def crossings(x, touch):
    """Crossings of the triangles of a surface at ``x``, and pairs that are too close to tell."""
    points = np.ascontiguousarray(positions(x))
    return crossing.count(points, touch.triangles, touch.edges, np.empty((1, 2), np.int64))


def contact_of(points, triangles, area, t, rest=None, stiffness=1.0, low=NOBODY, high=NOBODY):
    """Contact of a surface of thickness ``t`` (a number or one a node)."""
    n = SIZE * len(points)
    thickness = np.full(len(points), float(t)) if np.ndim(t) == 0 else np.asarray(t)
    rest = points if rest is None else rest
    return contact.build(
        stiffness, np.inf, triangles, area, thickness, np.ascontiguousarray(rest),
        (*low, n), (*high, n + 1),
    )  # fmt: skip


def two_sheets(gap, one: Sheet, two: Sheet, t=1.0):
    """Coordinates and contact of two sheets ``gap`` apart, which are far apart at rest."""
    points, triangles, area = united(one, two)
    upper = np.arange(len(points)) >= len(one.points)
    rest, x = points.copy(), points.copy()
    rest[upper, 2] += FAR_APART * t
    x[upper, 2] += gap
    return placed(x), contact_of(points, triangles, area, t, rest)


def pairs_of(x, touch, margin=1.0):
    """Pairs listed at ``x`` with a ``margin`` as a share of the reach."""
    return pairs.find(x, touch, (1.0 + margin) * touch.reach)


def term_of(x, touch, listed=None) -> Term:
    """Contact with its pairs at ``x``, with a dense Hessian."""
    listed = pairs_of(x, touch) if listed is None else listed
    touching = no_contacts(touch, listed)

    def slope(y, g):
        return contact.evaluate(y, touch, listed, np.inf, touching, g)

    def second(y):
        contact.evaluate(y, touch, listed, np.inf, touching, np.zeros_like(y))
        matrix, K = np.zeros((y.size, y.size)), np.zeros((12, 12))
        for n in range(touching.count[0]):
            size = contact.block(y, touch, listed, touching, n, K)
            nodes = touching.nodes[n, :size]
            at = (SIZE * nodes[:, None] + np.arange(3)).ravel()
            matrix[np.ix_(at, at)] += K[: 3 * size, : 3 * size]
        for upper, nodes in ((False, touch.low_nodes), (True, touch.high_nodes)):
            platen = touch.high if upper else touch.low
            for i in range(len(nodes)):
                p, _, k = contact.platen_block(y, touch, upper, i)
                at = [SIZE * p + 2, platen]
                matrix[np.ix_(at, at)] += [[k, -k], [-k, k]]
        return matrix

    return Term(slope, second)


def wavy(seed, gap=0.5, amount=0.2):
    """Coordinates and contact of two shaken sheets, one smaller than the other."""
    x, touch = two_sheets(gap, Sheet(2, 2, 3, 3), Sheet(2, 1, 2.7, 2.5, (0.13, 0.21, 0.0)))
    shake = np.random.default_rng(seed).uniform(-amount, amount, positions(x).shape)
    return placed(positions(x) + shake), touch


def two_triangles(lower, upper):
    """Coordinates and contact of two triangles that are far apart at rest."""
    points = np.array([*lower, *upper], float)
    rest = points + np.outer([0, 0, 0, 1, 1, 1], [0, 0, 50.0])
    touch = contact_of(points, np.array([(0, 1, 2), (3, 4, 5)]), np.ones(6), 1.0, rest)
    return placed(points), touch


def between_platens(low, high):
    """Coordinates and contact of an upright wall between two platens."""
    sheet = Sheet(2, 2, 3.0, 3.0)
    points = sheet.points[:, [0, 2, 1]]
    ends = [np.flatnonzero(points[:, 2] == z) for z in (0.0, 3.0)]
    rest = points.copy()
    others = np.flatnonzero(points[:, 2] == 1.5)
    low_nodes, high_nodes = (np.concatenate([end, others]) for end in ends)
    touch = contact_of(
        points, sheet.triangles, sheet.area, 0.8, rest,
        low=(low_nodes, np.where(np.isin(low_nodes, others), 1.6, 0.08)),
        high=(high_nodes, np.where(np.isin(high_nodes, others), 1.6, 0.08)),
    )  # fmt: skip
    return placed(points, low, high), touch
