"""Where the unknowns of a lattice of plates are: blocks of the matrix, one for each node.

Coordinates of node i: position x[6 i : 6 i + 3] in m, rotation x[6 i + 3 : 6 i + 6] since the last
commit, as modified Rodrigues parameters in the frame of the node (`rotation`). The last two
coordinates are the heights of the platens, each of which has a block of its own.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import zero
from kernels.compile.jit import jit_exact

PER_NODE = 6  # coordinates of a node
POSITION = 3  # of them are those of its position


class Layout(NamedTuple):
    """Constraints of n coordinates, and their places in the matrix of nb blocks and u unknowns.

    leader (n,): the coordinate itself if it is free, that of a platen if it is tied to it, -1 if
    held. ratio (n,): move divided by that of the leader. driven: coordinate with a prescribed
    value, -1 if none. unknown (n,): of the coordinate that is followed, -1 if it is held or driven.
    slot (n,): place of a free coordinate in the block of its node, else -1. follows (n_nodes,):
    whether a coordinate of a node follows another one. block (n_nodes,): of each node, -1 if it has
    no free coordinate. size (nb,): unknowns of each block, the last of which is that of a platen
    that is free. point (nb, 3): of each block at rest, m. By unknown, (u,): scale: stiffness, N/m
    or N m, beside which a pivot is zero; weight: 1 for positions, m^2 for rotations, in the shift
    of a Hessian that is not positive; is_length: whether it is in m.
    """

    leader: np.ndarray
    ratio: np.ndarray
    driven: int
    unknown: np.ndarray
    slot: np.ndarray
    follows: np.ndarray
    block: np.ndarray
    size: np.ndarray
    point: np.ndarray
    scale: np.ndarray
    weight: np.ndarray
    is_length: np.ndarray


@jit_exact
def reduce(layout, g, residual):
    """Fill ``residual`` (n,) with the gradient ``g`` (n,) of the free and driven coordinates.

    Entries of tied coordinates are added to their leaders; those of held ones are zero.
    """
    zero(residual)
    for i in range(g.size):
        if layout.leader[i] >= 0:
            residual[layout.leader[i]] += layout.ratio[i] * g[i]


@jit_exact
def lead(layout, move, direction):
    """Write the moves of all coordinates that follow the driven one, which moves by ``move`` m."""
    for i in range(direction.size):
        if layout.leader[i] == layout.driven:
            direction[i] = layout.ratio[i] * move


@jit_exact
def tie(layout, vector):
    """Set entries of tied coordinates to those of their leaders times the ratio of their moves."""
    for i in range(vector.size):
        leader = layout.leader[i]
        if leader >= 0 and leader != i:
            vector[i] = layout.ratio[i] * vector[leader]
