"""Centre lines of the walls of a lattice: of an infill, or of the file of a custom structure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.sheet import Surface
from sweep.constants import MM

if TYPE_CHECKING:
    from sweep.design.network import Network


def network_of(lattice: Lattice) -> Network:
    """Centre lines and thickness of the walls, m; those of a file have no bottom and top rows.

    Not of a sheet, which is not drawn with lines.
    """
    assert not isinstance(lattice, Surface)
    import numpy as np

    from sweep.design.lattice import build_network
    from sweep.design.network import Network

    if not isinstance(lattice, CustomStructure):
        return build_network(lattice.geometry)
    structure = lattice.structure
    points = MM * np.array(structure.nodes_mm)
    thickness, none = MM * np.array(structure.thickness_mm), np.empty(0, np.int64)
    return Network(points, np.array(structure.walls), thickness, none, none)
