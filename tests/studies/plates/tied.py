"""Bodies of elements whose coordinates are held, follow one another, or follow a platen."""

from functools import cached_property

import numpy as np
from scipy.sparse import csc_array

from tests.studies.continuum.press import Press


class Tied:
    """A body by its unknowns q: u = ratio q[unknown], the last of which is the platen's move.

    body: has ``energy``, ``gradient``, ``hessians`` and ``places`` of coordinates u. unknown (n,):
    of each coordinate; ratio (n,): 0 where it is held.
    """

    def __init__(self, body, unknown, ratio):
        used, number = np.unique(
            np.append(unknown[ratio != 0.0], unknown.max()), return_inverse=True
        )
        self.body, self.ratio, self.size = body, ratio, len(used)
        self.unknown = np.zeros(len(ratio), np.int64)
        self.unknown[ratio != 0.0] = number[:-1]

    @cached_property
    def _pattern(self):
        """Places of the entries of element matrices in the sorted list of entries of the whole
        matrix.
        """
        at = self.unknown[self.body.places]
        row, column = np.broadcast_arrays(at[:, :, None], at[:, None, :])
        keys, place = np.unique((column * self.size + row).ravel(), return_inverse=True)
        column, row = np.divmod(keys, self.size)
        return place, row, np.searchsorted(column, np.arange(self.size + 1))

    def moved(self, q):
        """Coordinates u (n,)."""
        return self.ratio * q[self.unknown]

    def energy(self, q):
        """Energy of the body."""
        return self.body.energy(self.moved(q))

    def gradient(self, q):
        """Gradient in the unknowns."""
        slope = self.ratio * self.body.gradient(self.moved(q))
        return np.bincount(self.unknown, slope, minlength=self.size)

    def hessian(self, q):
        """Hessian in the unknowns."""
        by = self.ratio[self.body.places]
        own = self.body.hessians(self.moved(q)) * by[:, :, None] * by[:, None, :]
        place, row, start = self._pattern
        data = np.bincount(place, own.ravel(), minlength=len(row))
        return csc_array((data, row, start), shape=(self.size, self.size))


class Platen(Press):
    """Presses a `Tied` body by its last unknown, to strains of ``height``."""

    def __init__(self, tied, height):
        self.body, self.touch, self.terms, self.size = tied, None, [tied], tied.size
        self.free = np.arange(tied.size - 1)
        self.drive = np.zeros(tied.size)
        self.drive[-1] = -height
        self.damper = tied.hessian(np.zeros(tied.size))[self.free][:, self.free].diagonal()

    def force(self, gradient):
        """Force of the platen."""
        return -float(gradient[-1])
