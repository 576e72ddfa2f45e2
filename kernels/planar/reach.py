"""How far a step of a lattice may go, and what is near: lists kept while nodes move little."""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair, triple
from kernels.compile.jit import jit_exact, jit_owning, separate
from kernels.geometry import ccd, near_pairs
from kernels.geometry.near_pairs import Pairs
from kernels.linear import analysis
from kernels.linear.analysis import System
from kernels.terms import contact, friction, position_based
from kernels.terms.contact import Touching
from kernels.terms.couplings import couplings
from kernels.terms.friction import LaggedContacts

LEAST_LENGTH = 0.1  # of an element's length: no step shrinks it further
MARGIN = 1.0  # of the reach of contact: how much farther pairs are listed
PROJECTION_MARGIN = 1.0  # of the thickness: how much farther pairs to be moved apart are listed
ADVANCE = 0.9  # share of the way to the first contact that a step may use
AHEAD = 2.2  # times a move: how much farther pairs are listed; 2 would hold no other move


class Neighbours(NamedTuple):
    """Pairs found at ``anchor`` (n,) with ``margin`` (m), and the system that has room for them.

    projection_pairs: those that are moved apart after a step. touching: contacts at the last
    `evaluate`. lagged_contacts: contacts with friction.
    """

    pairs: Pairs
    anchor: np.ndarray
    margin: float
    system: System
    projection_pairs: Pairs
    touching: Touching
    lagged_contacts: LaggedContacts


@jit_exact
def step_limit(problem, x, dx, most):
    """Return the share of ``dx`` (at most 1) that keeps walls apart, open and long enough.

    ``most``: farthest move of a node in m. A bound tells first whether a check is needed.
    """
    scene, least, shortest = problem.scene, problem.buffers.least[0], np.inf
    first = contact.step_limit(
        x, dx, most, scene.contact, problem.neighbours.pairs, drift(problem, x)
    )
    if np.pi * 2.0 * most >= least.opening * least.length:
        first = min(first, _first_fold(x, dx, scene))
    if 2.0 * most >= (1.0 - LEAST_LENGTH) * least.length:
        for k in range(scene.walls.edges.shape[0]):
            i, j = pair(scene.walls.edges, k)
            shortest = min(shortest, ccd.first_shrink(x, dx, i, j, LEAST_LENGTH))
    return min(1.0, ADVANCE * first, shortest)


@jit_exact
def _first_fold(x, dx, scene):
    first, edges = np.inf, scene.walls.edges
    for k in range(scene.fold.limit.size):
        a, b, c = triple(scene.fold.nodes, k)
        first = min(first, ccd.first_fold(x, dx, a, b, c))
    for k in scene.bend.hinges:
        first = min(first, ccd.first_fold(x, dx, edges[k, 0], edges[k, 1], edges[k + 1, 1]))
    return first


@separate
@jit_owning
def list_neighbours(scene, x, move):
    """Return pairs, margin and projection pairs of `Neighbours` for a ``move`` (m) from ``x``."""
    if scene.contact.edges.shape[0] == 0:
        found, margin = near_pairs.empty(), np.inf
    else:
        margin = max(AHEAD * move, MARGIN * scene.contact.reach)
        found = near_pairs.find(x, scene.contact, scene.contact.reach + margin)
    projection_pairs, touch = near_pairs.empty(), scene.project.contact
    if touch.edges.shape[0] > 0:
        projection_pairs = near_pairs.find(x, touch, (1.0 + PROJECTION_MARGIN) * touch.reach)
    return found, margin, projection_pairs


@separate
@jit_owning
def make_system(scene, x, found, lagged_contacts):
    """Return the system with room for all that may soon share a term."""
    return analysis.analyse(scene.layout, scene.walls, couplings(x, scene, found, lagged_contacts))


@jit_owning
def find_neighbours(scene, x):
    """Return `Neighbours` at ``x``: pairs in reach, room for them, and no friction lagged yet."""
    found, margin, projection_pairs = list_neighbours(scene, x, 0.0)
    lagged_contacts = friction.no_contacts(found, scene.contact, scene.friction)
    system = make_system(scene, x, found, lagged_contacts)
    touching = contact.no_contacts(found)
    return Neighbours(found, x.copy(), margin, system, projection_pairs, touching, lagged_contacts)


@jit_owning
def renew_neighbours(scene, neighbours, x, move):
    """Return `Neighbours` with what was lacking at ``x``: entries of the matrix, or pairs for a
    ``move`` (m) beyond those listed. A factor outlives the pairs.
    """
    found, margin, projection_pairs = list_neighbours(scene, x, move)
    system, lagged_contacts = neighbours.system, neighbours.lagged_contacts
    if system.matrix.missing[0] != 0:
        system = make_system(scene, x, found, lagged_contacts)
    wider = friction.no_contacts(found, scene.contact, scene.friction)
    if wider.load.size > lagged_contacts.load.size:
        lagged_contacts = friction.moved(lagged_contacts, wider)
    touching = contact.no_contacts(found)
    return Neighbours(found, x.copy(), margin, system, projection_pairs, touching, lagged_contacts)


@jit_exact
def covers_projection(problem, x):
    """Return whether `projection_pairs` hold all that is near at ``x``, with half of the margin to
    spare.
    """
    scene = problem.scene
    if position_based.is_absent(scene.project):
        return True
    moved = near_pairs.farthest(x, problem.neighbours.anchor, scene.layout.n_nodes)
    return 4.0 * moved <= PROJECTION_MARGIN * scene.project.contact.reach


@jit_exact
def drift(problem, x):
    """Return how far a node has moved since the pairs were listed, m."""
    if problem.scene.contact.edges.shape[0] == 0:
        return 0.0
    return near_pairs.farthest(x, problem.neighbours.anchor, problem.scene.layout.n_nodes)


@jit_exact
def travel(problem, dx):
    """Return how far a node goes at most in a move, m."""
    return near_pairs.longest(dx, problem.scene.layout.n_nodes)


@jit_exact
def covers(problem, x, most):
    """Return whether the list holds all that matters while no node goes farther than ``most`` m."""
    return 2.0 * (drift(problem, x) + most) <= problem.neighbours.margin


@jit_exact
def least_gap(problem, x):
    """Return the smallest distance in m between lines that may touch, by either kind of contact."""
    scene, neighbours = problem.scene, problem.neighbours
    moved = near_pairs.farthest(x, neighbours.anchor, scene.layout.n_nodes)
    return min(
        contact.least_gap(x, scene.contact, neighbours.pairs, moved),
        contact.least_gap(x, scene.project.contact, neighbours.projection_pairs, moved),
    )
