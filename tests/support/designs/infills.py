"""Every family of infill, either way round, within every kind of edge."""

from sweep.design.infill import families, trait
from tests.support.designs.tables import lattice_with

WAYS = {None: ["pointy"], True: ["pointy", "flat"]}
KINDS = [(kind, way) for kind in families() for way in WAYS[trait(kind, "ORIENTED")]]
EDGES = {"free": {}, "closed": {"perimeters": 2}, "capped": {"solid_layers": 3}}


def lattice_of(kind, way="pointy", cells=(3, 3), **changes):
    """A lattice of 20 mm x 18 mm with thin walls."""
    box = {"width": 20e-3, "height": 18e-3, "wall_thickness": 0.2e-3}
    oriented = {"orientation": way} if trait(kind, "ORIENTED") else {}
    return lattice_with(kind=kind, **oriented, cells_x=cells[0], cells_y=cells[1], **box | changes)
