"""The smallest period of the infill of a case, as a frame of elements."""

from dataclasses import replace
from math import cos, sin
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.faults import MisfitError
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.sliced import Sliced
from sweep.design.drawing import extent, pitch
from sweep.design.infill import trait
from sweep.scene.beams import build_beams, plane_factors
from sweep.scene.images import draw

NODES = 3  # between the joints of a wall: buckling stresses are then exact within 1e-4
ALLOWED = "cells of a family, or the infill of a slicer, of even walls that bend"


class Infill(NamedTuple):
    """An endless infill. angle: of its axes from the width of the design, rad. name: for people.

    gyration: radius of gyration of walls over the value for even walls of the same mean thickness.
    """

    case: Case
    angle: float
    name: str
    gyration: float = 1.0


class Frame(NamedTuple):
    """One period as elements. The nodes of the period are numbered from 0.

    ends (m, 2): nodes; shift (m, 2, 2): by how many periods each end is moved; period (2,) m. along
    (m, 2): directions. length, thickness (m,) m. axial (m,): Y' A / l, N/m. bending (3, m): second
    derivatives 11, 12, 22 in the turns of the ends, N m. arc (2, m): as in `Beams`. filled: area of
    the walls over the area of the period.
    """

    ends: Ints
    shift: Ints
    period: Floats
    along: Floats
    length: Floats
    thickness: Floats
    axial: Floats
    bending: Floats
    arc: Floats
    filled: float

    @property
    def nodes(self) -> int:
        """Number of nodes of the period."""
        return int(self.ends.max()) + 1

    @property
    def area(self) -> float:
        """Area of the period, m^2."""
        return float(np.prod(self.period))


def infill_of(case: Case) -> Infill:
    """The infill of a case, made endless, without perimeters and solid layers; raises `MisfitError`
    if it has none.

    Its period is the smallest that repeats in x and in y. The axes of a slicer's pattern are the
    axes in which its family is drawn.
    """
    lattice = case.lattice
    if case.material.bend == "none" or case.material.yield_stress is not None:
        raise MisfitError(f"walls that are springs, or that yield; allowed: {ALLOWED}")
    if isinstance(lattice, Sliced) and (pattern := lattice.printed_as).is_even:
        side = pattern.side * lattice.fill_distance
        size = side * pitch(pattern.family, _way(pattern.family, None))
        period = _period(case, pattern.family, None, size)
        return Infill(period, lattice.fill_angle + pattern.turn, lattice.name, pattern.gyration)
    if isinstance(lattice, Cells) and lattice.grading == 1.0:
        low, high = extent(lattice.kind, lattice.orientation, (lattice.cells_x, lattice.cells_y))
        unit = pitch(lattice.kind, lattice.orientation)
        cells = np.array([lattice.cells_x, lattice.cells_y])
        whole = np.where(lattice.geometry.periodic, cells * unit, high - low)
        size = unit * (lattice.width, lattice.height) / whole
        period = _period(case, lattice.kind, lattice.orientation, size)
        return Infill(period, 0.0, lattice.name)
    uneven = isinstance(lattice, Sliced) and lattice.printed_as.family != ""
    why = " has walls of two thicknesses" if uneven else lattice.aperiodic
    raise MisfitError(f"{lattice.name}{why}; allowed: {ALLOWED}")


def _period(case: Case, kind: str, orientation: str | None, size: Floats) -> Case:
    """A case of the smallest period of cells of a size (2,), m."""
    way = _way(kind, orientation)
    cells = (1, 1)
    if trait(kind, "STAGGERED"):
        cells = (2, 1) if way == "flat" else (1, 2)
    width, height = (size * cells).tolist()
    lattice = {
        "kind": kind,
        "orientation": way,
        "cells_x": cells[0],
        "cells_y": cells[1],
        "width": width,
        "height": height,
        "depth": case.lattice.depth,
        "wall_thickness": case.lattice.wall_thickness,
        "boundary": "periodic",
        "imperfection": 0.0,
        "nodes_per_wall": NODES,
    }
    crush = {"mode": "displacement", "strain": 0.01}
    solver = {"joints": case.solver.joints}
    return Case.of(lattice=lattice, material=case.material, loading=crush, solver=solver)


def _way(kind: str, orientation: str | None) -> str | None:
    """The orientation, if the family has one."""
    return (orientation or "pointy") if trait(kind, "ORIENTED") else None


def frame_of(infill: Infill) -> Frame:
    """The elements of a period at rest, in the plane state of the material."""
    case = infill.case
    lattice = case.lattice
    assert isinstance(lattice, Cells)
    drawn = draw(case, lattice, lambda y: np.zeros_like(y), None)
    mesh = drawn.mesh
    if infill.gyration != 1.0:
        mesh = replace(mesh, gyration=np.full(len(mesh.edges), infill.gyration))
    beams = build_beams(mesh, drawn.arms, case)
    modulus = plane_factors(case.material)[0] * case.material.modulus
    node = np.unique(drawn.origin, return_inverse=True)[1]
    return Frame(
        ends=node[mesh.edges],
        shift=drawn.shift[mesh.edges],
        period=drawn.network.period,
        along=mesh.direction,
        length=mesh.rest_length,
        thickness=mesh.thickness,
        axial=modulus * beams.area / mesh.rest_length,
        bending=beams.stiffness,
        arc=beams.arc,
        filled=drawn.network.printed_area / float(np.prod(drawn.network.period)),
    )


def turned(stiffness: Floats, angle: float) -> Floats:
    """A stiffness (3, 3), of strains xx, yy and the engineering shear xy, in axes x' that lie at an
    angle (rad) from the given axes: C' = T^-T C T^-1 with T of the strains.
    """
    c, s = cos(angle), sin(angle)
    strains = np.array(
        [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
    )
    back = np.linalg.inv(strains)
    return np.asarray(back.T @ stiffness @ back)
