"""The arrays of an endless lattice: one period, images of its nodes, and the mean strain.

The last two coordinates are the width and the height of the period. The width is an unknown; the
height is prescribed.
"""

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.scene.beams import bends
from sweep.scene.images import Repeated, draw, images_of, parts_of
from sweep.scene.scene import Scene, assemble, force_scale


def build_periodic(case: Case) -> Scene:
    """Build the arrays of an endless lattice."""
    lattice = case.lattice
    assert isinstance(lattice, Cells)
    period = draw(case, lattice, lambda y: imperfection(lattice, y), None)
    network, n_nodes, rows = period.network, len(period.origin), np.empty(0, np.int64)
    anchor = int(network.bottom[0])
    numbering = Repeated(n_nodes, rows, rows, period.origin, period.shift)
    leader = _leaders(numbering, anchor, case)
    images = images_of(numbering, leader, (numbering.low, numbering.high), np.ones(2))
    parts = parts_of(case, period, numbering, leader, images)
    return Scene(
        period.mesh, network, assemble(case, period.mesh, numbering, parts),
        np.concatenate([period.whole.points.ravel(), np.zeros(n_nodes), network.period]),
        bottom=rows,
        top=np.array([numbering.high]),
        base=np.array([2 * anchor + 1]),
        force_scale=force_scale(case, network),
        velocity=np.zeros(numbering.size),
        around=period.around,
        solid_joint_share=float(period.arms.sheared.mean()),
    )  # fmt: skip


def imperfection(lattice: Cells, y: Floats) -> Floats:
    """Stress-free shift in x at heights ``y``, both in m.

    It is `lattice.imperfection` x wall thickness x cos(2 pi y / height).
    """
    wave = np.cos(2.0 * np.pi * y / lattice.height)
    return np.asarray(lattice.imperfection * lattice.wall_thickness * wave)


def _leaders(numbering: Repeated, anchor: int, case: Case) -> Ints:
    """The coordinate that each one follows: itself, or -1 if held.

    anchor: the node that is held to prevent rigid motions.
    """
    leader = np.arange(numbering.size)
    leader[[2 * anchor, 2 * anchor + 1]] = -1
    leader[numbering.unused] = -1
    if not bends(case):
        leader[numbering.rotation] = -1
    return leader
