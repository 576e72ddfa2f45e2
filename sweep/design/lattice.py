"""The lattice as drawn: the infill of a box, one period of a repeating lattice, a slicer's, a
user's.
"""

from functools import lru_cache

from sweep.design.box import build_box
from sweep.design.drawn import build_drawn
from sweep.design.geometry import Geometry
from sweep.design.network import Network
from sweep.design.period import build_period
from sweep.design.slicer.network import build_sliced, extruded_area


@lru_cache(maxsize=1024)
def build_network(geometry: Geometry) -> Network:
    """The joints and walls of a lattice."""
    if geometry.drawing is not None:
        return build_drawn(geometry.drawing, geometry.wall_thickness)
    if geometry.sliced is not None:
        return build_sliced(geometry)
    return build_period(geometry) if any(geometry.periodic) else build_box(geometry)


def counted_area(geometry: Geometry) -> float:
    """Area (m^2) whose mass budgets count: as extruded by a slicer, else the union of the walls."""
    if geometry.sliced is not None:
        return extruded_area(geometry)
    return build_network(geometry).printed_area
