"""What one step minimises: the sum of all terms, with its gradient, Hessian and admissible length.

    E(x) = |x - x~|_M^2 / (2 dt^2) + E_s + E_b + E_f + E_c - f . (x - x0) + D + D_f

dt is infinite in a static step: inertia and damping vanish. A term that a scene lacks is an empty
array.
"""

from typing import NamedTuple

import numpy as np

from kernels import bend, ccd, contact, damp, fold, friction, inertia, pairs, sparse, stretch
from kernels.jit import jit, jit_exact, jit_owning
from kernels.rows import pair, triple

SHORTEST = 0.1  # of an element's length: no step shrinks it further
MARGIN = 0.25  # of the reach of contact: how much farther pairs are listed
ADVANCE = 0.9  # share of the way to the first contact that a step may use


class Terms(NamedTuple):
    """One scene: the data of every term.

    mass (n,) kg and load (n,) N by coordinate. row (n,) as in `sparse.Matrix`. first (rows,): the
    skyline without contact.
    """

    law: object
    stretch: object
    bend: object
    fold: object
    contact: object
    friction: object
    damp: object
    mass: np.ndarray
    load: np.ndarray
    row: np.ndarray
    first: np.ndarray


class Step(NamedTuple):
    """One step from x0: x_pred (n,), duration dt in s, factor of the load, lagged friction."""

    x0: np.ndarray
    x_pred: np.ndarray
    dt: float
    factor: float
    grips: object


class Near(NamedTuple):
    """Pairs found at ``anchor`` (n,) with ``margin`` (m), and the matrix that has room for them."""

    pairs: object
    anchor: np.ndarray
    margin: float
    matrix: object


@jit
def stored(x, terms, near):
    """Return the recoverable energies (stretch, bend with folds, contact) in J."""
    return (
        stretch.energy(x, terms.stretch, terms.law),
        bend.energy(x, terms.bend) + fold.energy(x, terms.fold),
        contact.energy(x, terms.contact, near.pairs),
    )


@jit
def stored_gradient(x, terms, near, g):
    """Add the gradient of the recoverable energy to ``g``."""
    stretch.gradient(x, terms.stretch, terms.law, g)
    bend.gradient(x, terms.bend, g)
    fold.gradient(x, terms.fold, g)
    contact.gradient(x, terms.contact, near.pairs, g)


@jit
def energy(x, terms, step, near):
    """Return E in J."""
    stretching, bending, touching = stored(x, terms, near)
    total = stretching + bending + touching
    for i in range(x.size):
        total -= step.factor * terms.load[i] * (x[i] - step.x0[i])
    if step.dt < np.inf:
        total += inertia.energy(x, step.x_pred, terms.mass, step.dt)
        total += damp.energy(x, step.x0, terms, step.dt)
    return total + friction.energy(x, step.x0, step.grips, terms.friction.slip)


@jit
def gradient(x, terms, step, near, g):
    """Fill ``g`` (n,) with dE/dx by coordinate: what supports must supply, zero where free."""
    for i in range(g.size):
        g[i] = -step.factor * terms.load[i]
    stored_gradient(x, terms, near, g)
    if step.dt < np.inf:
        inertia.gradient(x, step.x_pred, terms.mass, step.dt, g)
        damp.gradient(x, step.x0, terms, step.dt, g)
    friction.gradient(x, step.x0, step.grips, terms.friction.slip, g)


@jit
def hessian(x, terms, step, near, projected):
    """Fill the matrix of ``near`` with d2E/dx2, or with its projected, positive part."""
    matrix = near.matrix
    matrix.values[:] = 0.0
    stretch.hessian(x, terms.stretch, terms.law, matrix, projected)
    bend.hessian(x, terms.bend, matrix, projected)
    fold.hessian(x, terms.fold, matrix, projected)
    contact.hessian(x, terms.contact, near.pairs, matrix, projected)
    if step.dt < np.inf:
        inertia.hessian(terms.mass, step.dt, matrix)
        damp.hessian(x, step.x0, terms, step.dt, matrix, projected)
    friction.hessian(x, step.x0, step.grips, terms.friction.slip, matrix, projected)


@jit_exact
def step_limit(x, dx, terms, near):
    """Return the share of ``dx`` (at most 1) that keeps walls apart, open and long enough."""
    first = contact.step_limit(x, dx, terms.contact, near.pairs)
    for k in range(terms.fold.limit.size):
        a, b, c = triple(terms.fold.nodes, k)
        first = min(first, ccd.first_fold(x, dx, a, b, c))
    shortest = np.inf
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        shortest = min(shortest, ccd.first_shrink(x, dx, i, j, SHORTEST))
    return min(1.0, ADVANCE * first, shortest)


@jit_owning
def find_near(x, terms, move):
    """Return `Near` at ``x`` for moves up to ``move`` (m): pairs in reach and a matrix for them."""
    anchor = x.copy()
    margin = max(3.0 * move, MARGIN * terms.contact.reach)
    if terms.contact.edges.shape[0] == 0:
        found = pairs.empty()
        margin = np.inf
    else:
        found = pairs.find(x, terms.contact, terms.contact.reach + margin)
    first = terms.first.copy()
    for k in range(found.node.size):
        if found.weight[k] > 0.0:
            p = found.node[k]
            a, b = pair(terms.contact.edges, found.edge[k])
            for i in range(2):
                for j in range(2):
                    for v in (a, b):
                        sparse.widen(first, terms.row[2 * p + i], terms.row[2 * v + j])
    for p in terms.contact.plate_nodes:
        sparse.widen(first, terms.row[terms.contact.high], terms.row[2 * p + 1])
    return Near(found, anchor, margin, sparse.shaped(terms.row, first))


@jit_exact
def covers(near, x, terms, reach):
    """Return whether the list still holds every pair that matters within ``reach`` of ``x``."""
    if terms.contact.edges.shape[0] == 0:
        return True
    n_nodes = terms.contact.tributary.size
    return 2.0 * (pairs.farthest(x, near.anchor, n_nodes) + reach) <= near.margin
