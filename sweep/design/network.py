"""A network of walls as drawn: joints, walls, printed area and mass."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.silhouette import silhouette


@dataclass(frozen=True)
class Network:
    """Centre lines at rest, before the imperfection.

    points (j, 2): joints in m; walls (w, 2): the two joints of each wall; wall_thickness (w,) in m.
    bottom, top: the joints of least and of greatest y, from left to right. Platens hold these
    joints; without a platen a dead load acts on the top ones. gyration (w,): radius of gyration of
    the section of each wall over the value of a rectangle of its thickness; None: 1. part (w,):
    length of each wall over the length of the smooth line of walls that it is part of; None: 1.
    """

    points: Floats
    walls: Ints
    wall_thickness: Floats
    bottom: Ints
    top: Ints
    gyration: Floats | None = field(default=None, kw_only=True)
    part: Floats | None = field(default=None, kw_only=True)

    @cached_property
    def length(self) -> Floats:
        """Length of every wall, (w,) m."""
        start, end = self.points[self.walls].swapaxes(0, 1)
        return np.asarray(np.linalg.norm(end - start, axis=1))

    def pieces(self, most: int) -> Ints:
        """Number of elements of every wall, (w,): ``most`` in a smooth line of walls, at least
        1.
        """
        if self.part is None:
            return np.full(len(self.walls), most)
        return np.maximum(np.rint(most * self.part).astype(np.int64), 1)

    @property
    def perimeter(self) -> Ints:
        """Joints on the perimeters of a slicer, (k,); none without one."""
        if self.gyration is None:
            return self.bottom[:0]
        points = self.points
        outer = (points == points.min(axis=0)) | (points == points.max(axis=0))
        return np.flatnonzero(outer.any(axis=1))

    @cached_property
    def printed_area(self) -> float:
        """Area of the union of the walls (m^2): flat caps, mitred corners, joints counted once.

        Corners sharper than 60 degrees are blunt.
        """
        from sweep.design.area import united_area  # the import loads the kernels

        return united_area(self.loops)

    @property
    def loops(self) -> Floats:
        """The print as overlapping polygons (k, 5, 2), m."""
        return np.array(silhouette(self.points, self.walls, self.wall_thickness))


def mass(network: Network, depth: float, density: float) -> float:
    """Mass of the print (kg)."""
    return density * depth * network.printed_area


def relative_density(network: Network, outer_size: tuple[float, float]) -> float:
    """Printed area / area of the outer box, (width + t)(height + t); sizes in m."""
    width, height = outer_size
    return network.printed_area / (width * height)
