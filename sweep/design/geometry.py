"""The numbers that define a drawing. No numpy here, so that a wrong config is refused at once."""

from typing import NamedTuple

from sweep.design.slicer.patterns import InfillLines

THIN = 1e-6  # least thickness of walls, as a share of the greatest


class Drawing(NamedTuple):
    """A network of walls that a user has drawn, from its lower left corner.

    joints: x and y of each, m. walls: the two joints of each. shares: thickness of each over the
    mean thickness of all, weighted by length; empty if they are equal.
    """

    joints: tuple[tuple[float, float], ...]
    walls: tuple[tuple[int, int], ...]
    shares: tuple[float, ...] = ()


class Geometry(NamedTuple):
    """A family of infill in a box; lengths in m.

    kind, orientation: as in `infill`. cells: columns and rows. box: width and height over centre
    lines, or of one period if the lattice repeats. periodic: whether it repeats in x and in y.
    grading: thickness of the walls at the top over the thickness at the bottom. outline: thickness
    of the walls round the infill, at the left and right sides and at the bottom and top; 0: no
    outline. sliced: how a slicer lays the infill; drawing: the walls themselves; with either, kind,
    orientation and cells have no meaning.
    """

    kind: str
    orientation: str | None
    cells: tuple[int, int]
    box: tuple[float, float]
    wall_thickness: float
    grading: float = 1.0
    outline: tuple[float, float] = (0.0, 0.0)
    periodic: tuple[bool, bool] = (False, False)
    sliced: InfillLines | None = None
    drawing: Drawing | None = None
