"""Places of the unknowns of a lattice of plates: blocks of the matrix, one for each node.

Coordinates of node i: position x[6 i : 6 i + 3] in m, rotation x[6 i + 3 : 6 i + 6] since the last
commit, as modified Rodrigues parameters in the frame of the node (`rotation`). The last two
coordinates are the heights of the platens, each of which has a block of its own.
"""

from typing import NamedTuple

import numpy as np

from kernels.geometry.space.vectors import SIZE

PER_NODE = SIZE  # coordinates of a node
POSITION = 3  # the first of them, its position


class Layout(NamedTuple):
    """Constraints of n coordinates, and their places in the matrix of nb blocks and u unknowns.

    leader (n,): the coordinate itself if it is free, the coordinate of the platen if it is tied to
    one, -1 if held; for an image, the coordinate of its original. ratio (n,): move divided by the
    move of the leader. driven: coordinate with a prescribed value, -1 if none. unknown (n,): number
    of the unknown that is the leader, -1 if none is. slot (n,): place of a free coordinate in the
    block of its node, else -1. follows (n_nodes,): whether a coordinate of a node follows a platen
    or is driven. block (n_nodes,): of each node, -1 if it has no free coordinate. An image has
    block and slots of its original. size (nb,): unknowns of each block, the last one being the
    block of a free platen. point (nb, 3): of each block at rest, m. By unknown, (u,): scale:
    stiffness, N/m or N m, relative to which a pivot is zero; weight: 1 for positions, m^2 for
    rotations, in the shift of a Hessian that is not positive; is_length: whether it is in m.
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
