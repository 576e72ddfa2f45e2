"""Symmetries of a gyroid that keep the axes: a sixteenth of the period is a model of the whole.

An operation moves a point x to s x + h / 2, with signs s and with h of zeros and ones, in periods.
The group, Ia-3d without its turns about diagonals, has all products of

    the translation by half a period along all axes,   the inversion at the origin,
    half turns about x, y and z with a shift.

A mean strain with one component becomes c times itself, c = 1 or -1. The periodic part v of the
displacement then fulfils v(s x + h / 2) = c s v(x).
"""

from typing import NamedTuple

import numpy as np

from tests.studies.surfaces.moduli import PAIRS

IDENTITY = ((1, 1, 1), (0, 0, 0))
GENERATORS = (
    ((1, 1, 1), (1, 1, 1)),
    ((-1, -1, -1), (0, 0, 0)),
    ((-1, 1, -1), (0, 1, 1)),
    ((1, -1, -1), (1, 1, 0)),
)


def _product(one, two):
    """The operation ``two``, then ``one``."""
    sign = tuple(a * b for a, b in zip(one[0], two[0], strict=True))
    return sign, tuple((a + b) % 2 for a, b in zip(one[1], two[1], strict=True))


def group(generators=GENERATORS):
    """All products of the generators, as pairs of s and h; the identity comes first."""
    members = [IDENTITY]
    for member in members:
        members += [new for g in generators if (new := _product(g, member)) not in members]
    return members


def characters(members, component):
    """Factors (g,) by which each operation multiplies a strain with this one of the `PAIRS`."""
    i, k = PAIRS[component]
    return np.array([sign[i] * sign[k] for sign, _ in members])


def images(members, at, n, inside):
    """Numbers (g, m) to which each operation maps nodes or cells ``at`` (m, 3) of n^3.

    inside: 1 for cells, which lie between node i and i + 1, 0 for nodes.
    """
    found = []
    for sign, half in members:
        s, h = np.array(sign), np.array(half)
        moved = (s * at + h * (n // 2) - inside * (s < 0)) % n
        found.append(np.ravel_multi_index(tuple(moved.T), (n, n, n)))
    return np.array(found)


def cells(members, n):
    """One cell of each set of equal ones among n^3, (m, 3); n: a multiple of 4."""
    at = np.indices((n, n, n)).reshape(3, -1).T
    first = np.arange(len(at))
    for member in members[1:]:
        np.minimum(first, images([member], at, n, 1)[0], out=first)
    return at[first == np.arange(len(at))]


class Nodes(NamedTuple):
    """Which unknowns move a node. number (m,): of the node that it follows. sign (m, 3): of its
    displacement over that node's, zero where symmetry holds it.
    """

    number: np.ndarray
    sign: np.ndarray


def follow(members, character, at, n):
    """The `Nodes` of nodes ``at`` (m, 3), under a strain of the ``character`` (g,)."""
    found = images(members, at, n, 0)
    which = found.argmin(axis=0)
    signs = character[:, None] * np.array([sign for sign, _ in members])
    sign = signs[which].astype(float)
    own = np.ravel_multi_index(tuple((at % n).T), (n, n, n))
    for g in range(len(members)):
        sign[(found[g] == own)[:, None] & (signs[g] < 0)] = 0.0
    return Nodes(found[which, np.arange(len(at))], sign)
