"""The lattice as drawn: joints, walls, and the material that its print takes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sweep.design.drawing import Sketch, extent, joints_and_walls, on_outline, pitch, sample
from sweep.design.silhouette import silhouette

if TYPE_CHECKING:
    from sweep.config.lattice_table import Lattice

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Network:
    """Centre lines at rest, before the imperfection.

    points (j, 2) in m; walls (w, 2), the two joints of each; wall_thickness (w,) in m;
    bottom, top: the joints of least and of greatest y, from left to right, be they a wall or the
    corners of cells. They are what platens hold, and what a dead load without a platen acts on.
    """

    points: Floats
    walls: Indices
    wall_thickness: Floats
    bottom: Indices
    top: Indices

    @cached_property
    def printed_area(self) -> float:
        """Area of the union of the walls (m^2): flat caps, mitred corners, joints counted once.

        Corners sharper than 60 degrees are blunt.
        """
        from sweep.design.area import united_area

        return united_area(self.loops)

    @property
    def loops(self) -> Floats:
        """The print as overlapping polygons (k, 5, 2), m."""
        return np.array(silhouette(self.points, self.walls, self.wall_thickness))


@lru_cache(maxsize=1024)
def build_network(lattice: Lattice) -> Network:
    """The infill stretched to the box; within an outline it is cut there and joined to it."""
    if lattice.boundary == "periodic":
        from sweep.design.period import build_endless

        return build_endless(lattice)
    points, walls = joints_and_walls(sketch(lattice))
    thickness = np.full(len(walls), lattice.wall_thickness)
    if lattice.grading != 1.0:
        thickness *= gradient(lattice)
    for on, outline in _outlines(lattice, points, walls):
        thickness[on] = outline
    thickness.flags.writeable = False
    y = points[:, 1]
    return Network(
        points, walls, thickness, np.flatnonzero(y == y.min()), np.flatnonzero(y == y.max())
    )


def sketch(lattice: Lattice, outlined: bool = True) -> Sketch:
    """What is drawn of a lattice; not ``outlined``: its infill alone, as far as cells are whole."""
    kind, way, cells = lattice.kind, lattice.orientation, (lattice.cells_x, lattice.cells_y)
    box = lattice.width, lattice.height
    if lattice.boundary == "periodic":
        low, high = extent(kind, way, cells)
        box = tuple((high - low) / (pitch(kind, way) * cells) * box)
    return Sketch(
        kind,
        way,
        cells,
        box,
        closed=outlined and lattice.perimeters > 0,
        capped=outlined and lattice.solid_layers > 0,
    )


def infill_walls(lattice: Lattice) -> tuple[Floats, Floats]:
    """Length (w,) in m and height of the middle / height of the box of every wall.

    Walls of the outline have length 0.
    """
    points, walls = joints_and_walls(sketch(lattice))
    ends = points[walls]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    for on, _ in _outlines(lattice, points, walls):
        length[on] = 0.0
    return length, ends[..., 1].mean(axis=1) / lattice.height


def gradient(lattice: Lattice) -> Floats:
    """Thickness of every wall / the mean over the length of all walls of the infill, (w,).

    Linear in the height of the wall's middle, with the ratio `grading` from top to bottom.
    """
    length, height = infill_walls(lattice)
    share = 1.0 + (lattice.grading - 1.0) * height
    return share / np.average(share, weights=length) if length.any() else share


def _outlines(
    lattice: Lattice, points: Floats, walls: Indices
) -> list[tuple[NDArray[np.bool_], float]]:
    """The walls on each side that is outlined, and their thickness."""
    found = []
    for axis, thickness in enumerate(lattice.outline):
        if thickness > 0.0:
            for side in (0.0, (lattice.width, lattice.height)[axis]):
                found.append((on_outline(points, walls, side, axis), thickness))
    return found


def mass(network: Network, depth: float, density: float) -> float:
    """Mass of the print (kg)."""
    return density * depth * network.printed_area


def relative_density(network: Network, lattice: Lattice) -> float:
    """Printed area over the area of the outer box, (width + t)(height + t)."""
    width, height = lattice.outer_size
    return network.printed_area / (width * height)


@lru_cache(maxsize=256)
def opening(drawn: Sketch) -> float:
    """Clear width between the centre lines of the narrowest cell: of its largest circle, m."""
    import shapely

    points, walls = joints_and_walls(sample(drawn))
    cells = shapely.get_parts(shapely.polygonize(shapely.linestrings(points[walls])))
    size = np.column_stack([shapely.area(cells), shapely.length(cells)])
    scale = size[:, 1].max() ** np.array([2, 1])
    _, differing = np.unique((size / scale).round(7), axis=0, return_index=True)
    tolerance = 1e-6 * max(drawn.box)
    radii = shapely.maximum_inscribed_circle(cells[differing], tolerance)
    return 2.0 * float(shapely.length(radii).min())
