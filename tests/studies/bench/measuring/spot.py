"""A state of a scene at which kernels are timed."""

import numpy as np

from kernels.compile.reference import referred
from kernels.linear.condensed.block_matrix import SIZE
from tests.studies.bench.measuring import loops
from tests.studies.bench.measuring.clock import seconds
from tests.support.kernels.solving import whole

SAMPLE = 2e-3  # s of calls in a sample


class Spot:
    """A state ``x`` of a scene, from where a step of ``dt`` sets out by ``move``."""

    def __init__(self, scene, x, move, dt=np.inf):
        if x.shape != scene.terms.coordinates.mass.shape:
            raise ValueError(f"a state of {x.size} coordinates for a scene of other ones")
        self.x, self.move, self.whole = x, move, whole(scene, x, dt=dt)
        self.most = np.abs(move[: 2 * len(scene.mesh.points)]).max()
        self.found = self.whole.found(x)[1]
        matrix = self.whole.neighbours.system.matrix
        self.ones = np.zeros(matrix.values.size)  # a factor of ones takes as long as any other
        nb = matrix.start.size - 1
        self.ones[: SIZE * nb].reshape(nb, SIZE)[:, [0, 5, 10]] = 1.0
        self.counts = {}

    def each(self, which):
        """Seconds of one call."""
        for before in (loops.EVALUATE, loops.FACTOR):
            self._repeat(before, 1)
        return self._each(which, lambda count: self._repeat(which, count))

    def search(self):
        """Seconds of one search for the pairs that a step can bring near."""
        given = self.x, referred(self.whole.terms), self.most
        return self._each("search", lambda count: loops.search(count, *given))

    def analyse(self):
        """Seconds of one analysis of the matrix."""
        given = self.x, referred(self.whole.terms), self.whole.neighbours.pairs
        return self._each("analyse", lambda count: loops.analyse(count, *given))

    def _repeat(self, which, count):
        given = self.whole.problem, self.whole.step, self.found, self.ones
        return loops.repeat(which, count, self.x, self.move, self.most, *given)

    def _each(self, name, calls):
        if name not in self.counts:
            self.counts[name] = 1
            calls(1)  # which may have to be compiled
            while seconds(lambda: calls(self.counts[name])) < SAMPLE:
                self.counts[name] *= 2
        idle = seconds(lambda: calls(0))
        return (seconds(lambda: calls(self.counts[name])) - idle) / self.counts[name]
