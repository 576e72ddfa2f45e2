"""The lattice as drawn: joints, walls, and the material that its print takes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sweep.params import Lattice

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Network:
    """Centre lines at rest, before the imperfection.

    points (j, 2) in m; walls (w, 2), the two joints of each; wall_thickness (w,) in m;
    bottom, top: the joints of the outer rows, from left to right.
    """

    points: Floats
    walls: Indices
    wall_thickness: Floats
    bottom: Indices
    top: Indices

    @cached_property
    def printed_area(self) -> float:
        """Area of the union of the walls (m^2): flat caps, mitred corners, joints counted once."""
        import shapely

        lines = shapely.linestrings(self.points[self.walls])
        bands = [
            shapely.buffer(
                shapely.line_merge(shapely.multilinestrings(lines[self.wall_thickness == t])),
                0.5 * t,
                cap_style="flat",
                join_style="mitre",
            )
            for t in np.unique(self.wall_thickness)
        ]
        return float(shapely.area(shapely.union_all(bands)))


def build_network(lattice: Lattice) -> Network:
    """A square grid: joints row by row from below, first the walls along x, then along y."""
    x = np.linspace(0.0, lattice.width, lattice.cells_x + 1)
    y = np.linspace(0.0, lattice.height, lattice.cells_y + 1)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    joint = np.arange(len(points)).reshape(len(y), len(x))
    along_x = np.stack([joint[:, :-1], joint[:, 1:]], axis=-1).reshape(-1, 2)
    along_y = np.stack([joint[:-1], joint[1:]], axis=-1).reshape(-1, 2)
    walls = np.concatenate([along_x, along_y])
    thickness = np.full(len(walls), lattice.wall_thickness)
    return Network(points, walls, thickness, bottom=joint[0], top=joint[-1])


def mass(network: Network, depth: float, density: float) -> float:
    """Mass of the print (kg)."""
    return density * depth * network.printed_area


def relative_density(network: Network) -> float:
    """Printed area over the area of the outer box, (width + t)(height + t)."""
    width, height = np.ptp(network.points, axis=0) + network.wall_thickness.max()
    return network.printed_area / float(width * height)
