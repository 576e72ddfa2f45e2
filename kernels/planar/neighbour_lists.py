"""Step limits and neighbour lists of a lattice; a list is kept while nodes move little."""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry import ccd, near_pairs
from kernels.geometry.near_pairs import Pairs
from kernels.linear.condensed import analysis
from kernels.linear.condensed.analysis import System
from kernels.planar import position_based
from kernels.planar.couplings import couplings
from kernels.shared.moves import ADVANCE, MOVE_MARGIN, listed_share
from kernels.terms import contact, friction, profile
from kernels.terms.contact import Touching
from kernels.terms.friction import LaggedContacts

LEAST_LENGTH = 0.1  # least length of an element after a move, as a share of its length before
MARGIN = 1.0  # least margin of the pair list, as a share of the reach of contact
PROJECTION_MARGIN = 1.0  # margin of the projection pairs, as a share of their reach


class Neighbours(NamedTuple):
    """Pairs listed at ``anchor`` (n,) with ``margin`` (m), and the linear system for them.

    projection_pairs: pairs that the projection after a step may move apart. touching: contacts at
    the last `evaluate`. lagged_contacts: contacts with lagged friction.
    """

    pairs: Pairs
    anchor: np.ndarray
    margin: float
    system: System
    projection_pairs: Pairs
    touching: Touching
    lagged_contacts: LaggedContacts


@jit_exact
def step_limit(problem, x, dx, far):
    """Return the share of ``dx`` (at most 1) up to which no wall touches, folds or vanishes.

    far: `travel` of ``dx``, m. Folds and lengths are checked only if ``far`` allows them to become
    critical.
    """
    scene, least = problem.scene, problem.buffers.least[0]
    shortest, far = listed_share(problem, dx, far)
    first = contact.step_limit(
        x, dx, far, scene.contact, problem.neighbours.pairs, drift(problem, x)
    )
    shortest = min(shortest, profile.step_limit(x, dx, scene.contact.profiles))
    if np.pi * 2.0 * far >= least.opening * least.length:
        first = min(first, _first_fold(x, dx, scene))
    if 2.0 * far >= (1.0 - LEAST_LENGTH) * least.length:
        for k in range(scene.walls.edges.shape[0]):
            i, j = pair(scene.walls.edges, k)
            shortest = min(shortest, ccd.first_shrink(x, dx, i, j, LEAST_LENGTH))
    return min(ADVANCE * first, shortest)


@jit_exact
def _first_fold(x, dx, scene):
    """Return the first share of ``dx`` at which two elements at a node fold flat."""
    first = np.inf
    for k in range(scene.fold.limit.size):
        a, b, c = triple(scene.fold.nodes, k)
        first = min(first, ccd.first_fold(x, dx, a, b, c))
    return first


@jit_owning
def list_neighbours(scene, x, move):
    """Return pairs, margin and projection pairs that stay valid for a ``move`` (m) from ``x``."""
    if scene.contact.edges.shape[0] == 0:
        pairs, margin = near_pairs.empty(), np.inf
    else:
        margin = max(MOVE_MARGIN * move, MARGIN * scene.contact.reach)
        pairs = near_pairs.find(x, scene.contact, scene.contact.reach + margin)
    projection_pairs, projection_contact = near_pairs.empty(), scene.project.contact
    if projection_contact.edges.shape[0] > 0:
        projection_pairs = near_pairs.find(
            x, projection_contact, (1.0 + PROJECTION_MARGIN) * projection_contact.reach
        )
    return pairs, margin, projection_pairs


@jit_owning
def make_system(scene, x, pairs, lagged_contacts):
    """Return the system with room for all couplings of nodes that may soon share a term."""
    return analysis.analyse(scene.layout, scene.walls, couplings(x, scene, pairs, lagged_contacts))


@jit_owning
def find_neighbours(scene, x):
    """Return `Neighbours` at ``x``, without lagged friction."""
    pairs, margin, projection_pairs = list_neighbours(scene, x, 0.0)
    lagged_contacts = friction.no_contacts(pairs, scene.contact, scene.friction)
    system = make_system(scene, x, pairs, lagged_contacts)
    touching = contact.no_contacts(pairs)
    return Neighbours(pairs, x.copy(), margin, system, projection_pairs, touching, lagged_contacts)


@jit_owning
def renew_neighbours(scene, neighbours, x, move):
    """Return `Neighbours` at ``x`` that hold for a ``move`` (m), and add missing entries to the
    matrix.

    If no entry is missing, the system is the same, and its factor remains valid.
    """
    pairs, margin, projection_pairs = list_neighbours(scene, x, move)
    system, lagged_contacts = neighbours.system, neighbours.lagged_contacts
    if system.matrix.missing[0] != 0:
        system = make_system(scene, x, pairs, lagged_contacts)
    wider = friction.no_contacts(pairs, scene.contact, scene.friction)
    if wider.load.size > lagged_contacts.load.size:
        lagged_contacts = friction.enlarged(lagged_contacts, wider)
    touching = contact.no_contacts(pairs)
    return Neighbours(pairs, x.copy(), margin, system, projection_pairs, touching, lagged_contacts)


@jit_exact
def covers_projection(problem, x):
    """Return whether `projection_pairs` are valid at ``x`` with half of their margin left."""
    scene = problem.scene
    if position_based.is_absent(scene.project):
        return True
    moved = near_pairs.farthest(x, problem.neighbours.anchor, scene.layout.n_nodes)
    return 4.0 * moved <= PROJECTION_MARGIN * scene.project.contact.reach


@jit_exact
def drift(problem, x):
    """Return the longest move of a node since the pairs were listed, m."""
    if problem.scene.contact.edges.shape[0] == 0:
        return 0.0
    return near_pairs.farthest(x, problem.neighbours.anchor, problem.scene.layout.n_nodes)


@jit_exact
def longest(problem, dx):
    """Return the longest move of a node in ``dx``, m."""
    return near_pairs.longest(dx, problem.scene.layout.n_nodes)


@jit_exact
def least_gap(problem, x):
    """Return the smallest distance in m between centre lines that may touch, by barrier or by
    projection.
    """
    scene, neighbours = problem.scene, problem.neighbours
    moved = near_pairs.farthest(x, neighbours.anchor, scene.layout.n_nodes)
    return min(
        contact.least_gap(x, scene.contact, neighbours.pairs, moved),
        contact.least_gap(x, scene.project.contact, neighbours.projection_pairs, moved),
    )
