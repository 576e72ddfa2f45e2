"""What one step minimises: the sum of all terms, with its gradient, Hessian and admissible length.

    E(x) = E_s + E_b + E_f + E_c - f . u + |x - x~|_M^2 / (2 h^2) + D(u) + D_f(u),   u = x - y

u / h is the velocity at its end (`scheme`). h is infinite in a static step, y = x0: inertia and
damping vanish. A term that a scene lacks is an empty array.
"""

from typing import NamedTuple

import numpy as np

from kernels.terms import bend, elements as chain, contact, damping as damp, fold, friction, inertia, position_based as project, spring, stretch
from kernels.geometry import ccd, near_pairs as pairs
from kernels.linear import analysis as pattern, system
from kernels.terms.couplings import couplings
from kernels.linear.block_matrix import clear
from kernels.compile.jit import jit_exact, jit_owning, separate
from kernels.arrays import add, pair, triple, zero, zero_rows

STRETCH, BEND, CONTACT = range(3)
(SHORTEST, OPENING), (WHOLE, RUBBED) = range(2), range(2)
LEAST_LENGTH = 0.1  # of an element's length: no step shrinks it further
MARGIN = 1.0  # of the reach of contact: how much farther pairs are listed
CROWD = 1.0  # of the thickness: how much farther pairs to be moved apart are listed
ADVANCE = 0.9  # share of the way to the first contact that a step may use
AHEAD = 2.2  # times a move: how much farther pairs are listed; 2 would hold no other move


class Terms(NamedTuple):
    """One scene: the data of every term. mass (n,) kg and load (n,) N by coordinate."""

    law: object
    walls: object
    stretch: object
    bend: object
    fold: object
    spring: object
    contact: object
    friction: object
    damp: object
    mass: np.ndarray
    load: np.ndarray
    layout: object
    project: object


class Step(NamedTuple):
    """One step: its start, x_pred (n,), h in s, factor of the load, lagged friction and its eps,
    share of its end in the book.
    """

    before: object
    x_pred: np.ndarray
    dt: float
    factor: float
    grips: object
    slip: float
    theta: float


class Near(NamedTuple):
    """Pairs found at ``anchor`` (n,) with ``margin`` (m), and the system that has room for them.

    crowd: pairs that are moved apart after a step.
    """

    pairs: object
    anchor: np.ndarray
    margin: float
    system: object
    crowd: object


class At(NamedTuple):
    """What `evaluate` found at x. g (n,): gradient by coordinate, what supports must supply.

    elastic, rubbing, material, u (n,): gradients of the stored energy, of friction and of damping;
    x - y. stored (3,): E_s with springs, E_b with folds, E_c in J. sum (2,): E and D_f, J. least
    (2,): shortest element in m, least opening of two arms in rad.
    """

    g: np.ndarray
    elastic: np.ndarray
    rubbing: np.ndarray
    material: np.ndarray
    u: np.ndarray
    stored: np.ndarray
    sum: np.ndarray
    least: np.ndarray
    shape: object
    stiffness: object


@jit_exact
def evaluate(x, terms, step, near, at, projected):
    """Return E in J; fill ``at``, with the walls' part of the (``projected``) Hessian."""
    _start(x, step, at)
    store(x, terms, step, at, projected)
    at.stored[CONTACT] = contact.evaluate(
        x, terms.contact, near.pairs, drift(x, terms, near), at.elastic
    )
    total = at.stored[STRETCH] + at.stored[BEND] + at.stored[CONTACT]
    for i in range(x.size):
        total -= step.factor * terms.load[i] * at.u[i]
        at.g[i] = at.elastic[i] - step.factor * terms.load[i]
    if step.dt < np.inf:
        total += inertia.evaluate(x, step.x_pred, terms.mass, step.dt, at.g)
        total += _damping(terms, step, at, projected)
    at.sum[WHOLE], at.sum[RUBBED] = total, 0.0
    return rub(terms, step, at)


@jit_exact
def store(x, terms, step, at, projected):
    """Fill ``at`` with what the walls store at ``x`` and its derivatives; elastic adds up."""
    walls, shape = terms.walls, at.shape
    at.least[SHORTEST] = chain.measure(x, walls, shape)
    opened = bend.turns(x, walls, terms.bend, step.before.frame, shape)
    chain.clear(shape, at.stiffness)
    at.stored[STRETCH] = stretch.evaluate(terms.stretch, terms.law, shape, at.stiffness, projected)
    at.stored[BEND] = bend.evaluate(walls, terms.bend, shape, at.stiffness, projected)
    chain.gather(walls, shape, at.elastic)
    at.stored[STRETCH] += spring.evaluate(x, terms.spring, at.elastic)
    folding, at.least[OPENING] = fold.evaluate(x, terms.fold, at.elastic)
    at.stored[BEND] += folding
    at.least[OPENING] = min(opened, at.least[OPENING])


@jit_exact
def _start(x, step, at):
    for i in range(x.size):
        at.u[i] = x[i] - step.before.y[i]
    for part in (at.elastic, at.material, at.rubbing):
        zero(part)


@jit_exact
def _damping(terms, step, at, projected):
    zero_rows(at.shape.slope)
    zero(at.shape.moment)
    total = damp.evaluate(
        at.u, terms, step.before, step.dt, at.shape, at.stiffness, projected, at.material
    )
    add(at.material, at.g)
    return total


@jit_exact
def rub(terms, step, at):
    """Exchange D_f and its gradient in ``at`` for those of the grips of ``step``; return E."""
    if terms.friction.mu == 0.0:
        return at.sum[WHOLE]
    for i in range(at.g.size):
        at.g[i] -= at.rubbing[i]
        at.rubbing[i] = 0.0
    rubbed = friction.evaluate(at.u, step.grips, step.slip, at.rubbing)
    add(at.rubbing, at.g)
    at.sum[WHOLE] += rubbed - at.sum[RUBBED]
    at.sum[RUBBED] = rubbed
    return at.sum[WHOLE]


@jit_exact
def factor(x, terms, step, near, at, projected, through):
    """Factor the Hessian at the ``x`` of the last `evaluate`; return as `system.factor` does."""
    matrix = near.system.matrix
    clear(matrix)
    fold.hessian(x, terms.fold, matrix, projected)
    spring.hessian(x, terms.spring, matrix, projected)
    contact.hessian(x, terms.contact, near.pairs, matrix, projected)
    friction.hessian(at.u, step.grips, step.slip, matrix, projected)
    if step.dt < np.inf:
        inert, drag = 1.0 / (step.dt * step.dt), terms.damp.alpha_m / step.dt
        for i in range(x.size):
            matrix.diagonal[i] += inert * terms.mass[i]
        for i in range(2 * terms.layout.n_nodes):
            matrix.diagonal[i] += drag * terms.mass[i]
    return system.factor(near.system, terms.layout, terms.walls, at.stiffness, projected, through)


@jit_exact
def step_limit(x, dx, most, terms, near, at):
    """Return the share of ``dx`` (at most 1) that keeps walls apart, open and long enough.

    ``most``: farthest move of a node in m. A bound tells first whether a check is needed.
    """
    shortest = np.inf
    first = contact.step_limit(x, dx, most, terms.contact, near.pairs, drift(x, terms, near))
    if np.pi * 2.0 * most >= at.least[OPENING] * at.least[SHORTEST]:
        first = min(first, _first_fold(x, dx, terms))
    if 2.0 * most >= (1.0 - LEAST_LENGTH) * at.least[SHORTEST]:
        for k in range(terms.walls.edges.shape[0]):
            i, j = pair(terms.walls.edges, k)
            shortest = min(shortest, ccd.first_shrink(x, dx, i, j, LEAST_LENGTH))
    return min(1.0, ADVANCE * first, shortest)


@jit_exact
def _first_fold(x, dx, terms):
    first, edges = np.inf, terms.walls.edges
    for k in range(terms.fold.limit.size):
        a, b, c = triple(terms.fold.nodes, k)
        first = min(first, ccd.first_fold(x, dx, a, b, c))
    for k in terms.bend.hinges:
        first = min(first, ccd.first_fold(x, dx, edges[k, 0], edges[k, 1], edges[k + 1, 1]))
    return first


@separate
@jit_owning
def list_near(x, terms, move):
    """Return (pairs, margin, crowd) of `Near` at ``x`` for a ``move`` (m) of the nodes."""
    if terms.contact.edges.shape[0] == 0:
        found, margin = pairs.empty(), np.inf
    else:
        margin = max(AHEAD * move, MARGIN * terms.contact.reach)
        found = pairs.find(x, terms.contact, terms.contact.reach + margin)
    crowd, touch = pairs.empty(), terms.project.contact
    if touch.edges.shape[0] > 0:
        crowd = pairs.find(x, touch, (1.0 + CROWD) * touch.reach)
    return found, margin, crowd


@separate
@jit_owning
def make_system(x, terms, found, grips):
    """Return the system with room for all that may soon share a term."""
    return pattern.analyse(terms.layout, terms.walls, couplings(x, terms, found, grips))


@jit_owning
def find_near(x, terms, grips, move):
    """Return `Near` at ``x`` for a ``move`` (m): pairs in reach and room for them."""
    found, margin, crowd = list_near(x, terms, move)
    return Near(found, x.copy(), margin, make_system(x, terms, found, grips), crowd)


@jit_owning
def renew(near, x, terms, grips, move):
    """Return `Near` with what was lacking at ``x``: room in the matrix, or pairs for a ``move`` (m)
    beyond those listed.
    """
    found, margin, crowd = list_near(x, terms, move)
    solver = near.system
    if solver.matrix.missing[0] != 0:
        solver = make_system(x, terms, found, grips)
    return Near(found, x.copy(), margin, solver, crowd)


@jit_exact
def holds_crowd(near, x, terms):
    """Return whether the crowd has all that is near at ``x``, with half of its room to spare."""
    if project.is_absent(terms.project):
        return True
    moved = pairs.farthest(x, near.anchor, terms.layout.n_nodes)
    return 4.0 * moved <= CROWD * terms.project.contact.reach


@jit_exact
def drift(x, terms, near):
    """Return how far a node has moved since the pairs were listed, m."""
    if terms.contact.edges.shape[0] == 0:
        return 0.0
    return pairs.farthest(x, near.anchor, terms.layout.n_nodes)


@jit_exact
def travel(dx, terms):
    """Return how far a node goes at most in a move, m."""
    return pairs.longest(dx, terms.layout.n_nodes)


@jit_exact
def covers(near, x, terms, most):
    """Return whether the list holds all that matters while no node goes farther than ``most`` m."""
    return 2.0 * (drift(x, terms, near) + most) <= near.margin


@jit_exact
def least_gap(x, terms, near):
    """Return the smallest distance in m between lines that may touch, by either kind of contact."""
    moved = pairs.farthest(x, near.anchor, terms.layout.n_nodes)
    return min(
        contact.least_gap(x, terms.contact, near.pairs, moved),
        contact.least_gap(x, terms.project.contact, near.crowd, moved),
    )
