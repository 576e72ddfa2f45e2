"""Step limits and neighbour lists of plates; a list is kept while nodes move little."""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.space import near
from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.matrix import Matrix
from kernels.plates import couplings
from kernels.plates.contacts import admissible, friction, mirror, pairs
from kernels.plates.contacts.friction import LaggedContacts
from kernels.plates.contacts.pairs import Pairs
from kernels.plates.contacts.touching import Touching, no_contacts
from kernels.plates.layout import PER_NODE, POSITION
from kernels.shared.moves import MOVE_MARGIN, listed_share

MARGIN = 0.5  # least margin of the pair list, as a share of the reach of contact
MOST_TURN = 0.125  # largest turn of a node in one move: w, the tangent of a quarter of the angle


class Neighbours(NamedTuple):
    """Pairs listed at ``anchor`` (n,) with ``margin`` (m), and the matrix with room for them.

    touching: contacts at the last `evaluate`. lagged_contacts: contacts with lagged friction.
    """

    pairs: Pairs
    anchor: np.ndarray
    margin: float
    matrix: Matrix
    touching: Touching
    lagged_contacts: LaggedContacts


@jit_exact
def n_nodes(scene):
    """Return the number of nodes."""
    return scene.layout.block.size


@jit_owning
def list_pairs(scene, x, move):
    """Return pairs that stay valid for a ``move`` (m) from ``x``, and their margin, m."""
    margin = max(MOVE_MARGIN * move, MARGIN * scene.contact.reach)
    return pairs.find(x, scene.contact, scene.contact.reach + margin), margin


@jit_owning
def make_matrix(scene, listed, lagged_contacts):
    """Return the matrix with room for all couplings of nodes that may soon share a term."""
    layout = scene.layout
    entries = couplings.couplings(scene, listed, lagged_contacts)
    return analyse(layout.size, entries, layout.point)


@jit_owning
def find_neighbours(scene, x):
    """Return `Neighbours` at ``x``, without lagged friction."""
    listed, margin = list_pairs(scene, x, 0.0)
    lagged_contacts = friction.no_contacts(listed, scene.contact, scene.friction)
    matrix = make_matrix(scene, listed, lagged_contacts)
    touching = no_contacts(scene.contact, listed)
    return Neighbours(listed, x.copy(), margin, matrix, touching, lagged_contacts)


@jit_owning
def renew_neighbours(scene, neighbours, x, move):
    """Return `Neighbours` at ``x`` that hold for a ``move`` (m), and add missing entries to the
    matrix.

    If no entry is missing, the matrix is the same, and its factor remains valid.
    """
    listed, margin = list_pairs(scene, x, move)
    matrix, lagged_contacts = neighbours.matrix, neighbours.lagged_contacts
    if matrix.missing[0] != 0:
        matrix = make_matrix(scene, listed, lagged_contacts)
    lagged_contacts = friction.with_room(lagged_contacts, listed, scene.contact, scene.friction)
    touching = no_contacts(scene.contact, listed)
    return Neighbours(listed, x.copy(), margin, matrix, touching, lagged_contacts)


@jit_exact
def drift(problem, x):
    """Return the longest move of a node since the pairs were listed, m."""
    return near.farthest(x, problem.neighbours.anchor, n_nodes(problem.scene))


@jit_exact
def longest(problem, dx):
    """Return the longest move of a node in ``dx``, m."""
    return near.longest(dx, n_nodes(problem.scene))


@jit_exact
def covers_projection(problem, x):
    """Return True: no node is moved after a step."""
    return True


@jit_exact
def step_limit(problem, x, dx, far):
    """Return the share of ``dx`` (at most 1) up to which no wall crosses another or a platen, and
    no node turns far.

    far: `travel` of ``dx``, m.
    """
    scene = problem.scene
    shortest, far = listed_share(problem, dx, far)
    first = admissible.step_limit(
        x, dx, far, scene.contact, problem.neighbours.pairs, drift(problem, x)
    )
    turn = _longest_turn(dx, n_nodes(scene))
    if turn > MOST_TURN:
        shortest = min(shortest, MOST_TURN / turn)
    return mirror.step_limit(x, dx, scene.mirror, min(first, shortest))


@jit_exact
def _longest_turn(dx, n):
    """Return the largest change of w of one of ``n`` nodes in ``dx``."""
    most = 0.0
    for i in range(n):
        at = PER_NODE * i + POSITION
        most = max(most, dx[at] ** 2 + dx[at + 1] ** 2 + dx[at + 2] ** 2)
    return most**0.5


@jit_exact
def least_gap(problem, x):
    """Return the smallest distance in m between mid-surfaces that may touch."""
    scene, moved = problem.scene, drift(problem, x)
    least = admissible.least_gap(x, scene.contact, problem.neighbours.pairs, moved)
    return mirror.least_gap(x, scene.mirror, least)
