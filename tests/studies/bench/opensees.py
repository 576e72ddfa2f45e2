"""A case without contact in OpenSees: corotational elastic beams on our nodes, masses and load.

The same steps of the same scheme, backward Euler, to the same residual. `openseespy` is optional.
"""

import ctypes
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from sweep.scene.loading import stages, tolerances
from sweep.scene.scene import time_step
from tests.studies.bench.measuring.clock import seconds
from tests.studies.bench.measuring.marching import Spent


@cache
def library():
    """The package; ImportError where it is not installed or cannot be loaded."""
    binary = find_spec("openseespylinux")
    if binary is not None:  # its LAPACK does not find the BLAS that lies beside it
        for blas in Path(binary.origin).parent.glob("lib/libblas.so*"):
            ctypes.CDLL(str(blas), ctypes.RTLD_GLOBAL)
    try:
        return import_module("openseespy.opensees")
    except RuntimeError as error:  # its name for a binary that cannot be loaded
        raise ImportError(str(error)) from error


def model(ops, case, scene):
    """Nodes with their masses, clamped below, and beams."""
    mesh, mass = scene.mesh, scene.terms.coordinates.mass
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    for i, (x, y) in enumerate(mesh.points.tolist()):
        ops.node(i, x, y)
        ops.mass(i, *mass[2 * i : 2 * i + 2].tolist(), 0.0)
    for i in {c // 2 for c in scene.bottom.tolist()}:
        ops.fix(i, 1, 1, 1)
    for k, (i, j) in enumerate(mesh.edges.tolist()):
        t = float(mesh.thickness[k])
        area, inertia = case.lattice.depth * t, case.lattice.depth * t**3 / 12.0
        ops.element("elasticBeamColumn", k, i, j, area, case.material.modulus, inertia, 1)


def load(ops, case, scene):
    """The dead load, until it is taken off."""
    last = case.loading.release_time + 0.5 * time_step(case)
    ops.timeSeries("Rectangular", 1, 0.0, last)
    ops.pattern("Plain", 1, 1)
    for c in scene.terms.coordinates.load.nonzero()[0].tolist():
        ops.load(c // 2, 0.0, float(scene.terms.coordinates.load[c]), 0.0)


class Peer:
    """A case in OpenSees, with one of its linear ``solver``s."""

    def __init__(self, case, scene, solver):
        self.case, self.scene, self.solver, self.ops = case, scene, solver, library()

    def whole(self, released=True):
        """March through all steps, or until the load is taken off, from rest."""
        ops, dt = self.ops, time_step(self.case)
        model(ops, self.case, self.scene)
        load(ops, self.case, self.scene)
        ramps = [phase.stage for phase in stages(self.case, self.scene)]
        allowed = tolerances(self.case, self.scene, ramps[0])
        ops.numberer("RCM")
        ops.constraints("Plain")
        ops.system(self.solver)
        ops.test("NormUnbalance", allowed.force, allowed.iterations)
        ops.algorithm("Newton")
        ops.integrator("BackwardEuler")
        ops.analysis("Transient")
        steps = [ramp.steps for ramp in ramps]
        iterations = []
        spent = seconds(lambda: self._through(sum(steps) if released else steps[0], dt, iterations))
        return Spent(spent, sum(iterations))

    def _through(self, steps, dt, iterations):
        for _ in range(steps):
            if self.ops.analyze(1, dt) != 0:
                raise RuntimeError("OpenSees found no equilibrium")
            iterations.append(self.ops.testIter())

    def moved(self):
        """How far every node has moved, (n, 2) m."""
        return np.array([self.ops.nodeDisp(i)[:2] for i in range(len(self.scene.mesh.points))])
