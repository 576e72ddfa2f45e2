"""Coordinates of images, which follow two others: dx_c = dx_of + times dx_mean.

An endless lattice is one period of it: an image of a node is as many periods away as ``times``
says, and the mean strain changes the period.
"""

from typing import NamedTuple

import numpy as np

from kernels.jit import jit_exact


class Images(NamedTuple):
    """coordinate (k,): those of images. By coordinate (n,): of, the one that is repeated (-1 if it
    is held), mean, the size of a period, and times. All are empty in a scene without images.
    """

    coordinate: np.ndarray
    of: np.ndarray
    mean: np.ndarray
    times: np.ndarray


NONE = Images(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0))


@jit_exact
def spread(images, move):
    """Write the moves of all images to ``move`` (n,), given those of the others."""
    for c in images.coordinate:
        of = images.of[c]
        move[c] = images.times[c] * move[images.mean[c]]
        if of >= 0:
            move[c] += move[of]


@jit_exact
def collect(images, force):
    """Add the forces (n,) on images to those on what they follow."""
    for c in images.coordinate:
        of = images.of[c]
        force[images.mean[c]] += images.times[c] * force[c]
        if of >= 0:
            force[of] += force[c]
        force[c] = 0.0
