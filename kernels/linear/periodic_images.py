"""Coordinates of images, which follow two others: dx_c = dx_of + times dx_mean.

An endless lattice is one period of it: an image of a node is as many periods away as ``times``
says, and the mean strain changes the period. A row of images (k, 4) is c, of, mean, times; of = -1:
held.
"""

import numpy as np

from kernels.compile.jit import jit_exact

NONE = np.empty((0, 4), np.int64)


@jit_exact
def spread(images, move):
    """Write the moves of all images to ``move`` (n,), given those of the others."""
    for k in range(images.shape[0]):
        c, of = images[k, 0], images[k, 1]
        move[c] = images[k, 3] * move[images[k, 2]]
        if of >= 0:
            move[c] += move[of]


@jit_exact
def collect(images, force):
    """Add the forces (n,) on images to those on what they follow."""
    for k in range(images.shape[0]):
        c, of = images[k, 0], images[k, 1]
        force[images[k, 2]] += images[k, 3] * force[c]
        if of >= 0:
            force[of] += force[c]
        force[c] = 0.0
