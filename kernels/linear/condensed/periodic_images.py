"""Coordinates of periodic images, which follow two others: dx_c = dx_of + times dx_mean.

A periodic lattice is modelled by one period. The image c of a coordinate ``of`` is ``times``
periods away from its original, and the coordinate ``mean`` is the length of the period. A row of
images (k, 4) is c, of, mean, times; of = -1: held.
"""

import numpy as np

from kernels.compile.jit import jit_exact

NONE = np.empty((0, 4), np.int64)


@jit_exact
def spread(images, move):
    """Write the moves of all images to ``move`` (n,), given the moves that they follow."""
    for k in range(images.shape[0]):
        c, of = images[k, 0], images[k, 1]
        move[c] = images[k, 3] * move[images[k, 2]]
        if of >= 0:
            move[c] += move[of]


@jit_exact
def collect(images, force):
    """Add the forces on images to the coordinates that they follow; ``force`` (n,), in place."""
    for k in range(images.shape[0]):
        c, of = images[k, 0], images[k, 1]
        force[images[k, 2]] += images[k, 3] * force[c]
        if of >= 0:
            force[of] += force[c]
        force[c] = 0.0
