"""A case without contact in numpy: the same steps of the same scheme, to the same residual.

    E(x) - f . x + |x - x~|_M^2 / (2 dt^2),   x~ = x + dt v

Every step of backward Euler ends in a minimum of that. Newton's method descends to it from x~ with
the exact Hessian, which is positive all the way.
"""

import numpy as np

from sweep.scene.loading import stages, tolerances
from tests.studies.bench.measuring.clock import seconds
from tests.studies.bench.measuring.marching import Spent
from tests.studies.bench.peers.beams import Beams


class Step:
    """What the steps of a stage minimise, each from its own x~."""

    def __init__(self, case, scene, beams, stage):
        assert stage.factor0 == stage.factor1, "the load must be dead"
        self.beams, self.allowed = beams, tolerances(case, scene, stage)
        self.inert = scene.terms.coordinates.mass[beams.free] / stage.duration**2
        self.load = stage.factor1 * scene.terms.coordinates.load[beams.free]
        self.lever = scene.terms.coordinates.lever[beams.free]

    def at(self, x, x_pred):
        """Energy, gradient (n,) and what the beams found."""
        found, inertia = self.beams.found(x), self.inert * (x - x_pred)
        energy = found.energy + 0.5 * inertia @ (x - x_pred) - self.load @ x
        return energy, found.gradient + inertia - self.load, found

    def minimum(self, x):
        """Where Newton's method comes to from x~ = ``x``, and in how many iterations."""
        x_pred, (energy, g, found) = x, self.at(x, x)
        for spent in range(self.allowed.iterations):
            if np.abs(g * self.lever).max() <= self.allowed.force:
                return x, spent
            dx = self.beams.towards(found, self.inert, g)
            most = energy + self.allowed.noise
            energy, g, found = self.at(x + dx, x_pred)
            while energy > most:
                dx *= 0.5
                energy, g, found = self.at(x + dx, x_pred)
            x = x + dx
        raise RuntimeError("numpy found no minimum")


class Peer:
    """A case in numpy, with one of the models of what its walls store."""

    def __init__(self, case, scene, model=Beams):
        self.case, self.scene, self.beams = case, scene, model(scene)
        self.x = scene.x_rest.copy()

    def whole(self, released=True):
        """March through all steps, or until the load is taken off, from rest."""
        ramps, iterations = [phase.stage for phase in stages(self.case, self.scene)], []
        spent = seconds(lambda: self._through(ramps if released else ramps[:1], iterations))
        return Spent(spent, sum(iterations))

    def _through(self, ramps, iterations):
        free = self.beams.free
        x, v = self.scene.x_rest[free], self.scene.velocity[free]
        for stage in ramps:
            step = Step(self.case, self.scene, self.beams, stage)
            for _ in range(stage.steps):
                end, spent = step.minimum(x + stage.duration * v)
                x, v = end, (end - x) / stage.duration
                iterations.append(spent)
        self.x[free] = x

    def moved(self):
        """How far every node has moved, (n, 2) m."""
        return (self.x - self.scene.x_rest)[: self.scene.mesh.points.size].reshape(-1, 2)
