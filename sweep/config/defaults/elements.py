"""How many elements a wall has if nobody says so: the cheapest mesh that ranks within 2 %.

`make mesh` measures it, in every column of a ranking, beside 24 elements a wall: of nine of ten
designs the error is at most 2 %. Which families need more elements is measured, not derived; so is
the number for the parallel lines of a slicer, whose walls run from side to side.
"""

from sweep.config.lattice_table import Lattice

THREE, EIGHT, TWELVE = 2, 7, 11  # nodes between joints
WITH_THREE = ("square", "brick", "hex", "circle")  # families of infill for which three suffice


def with_elements(lattice: Lattice) -> Lattice:
    """The lattice with the number of nodes inside its walls."""
    if "nodes_per_wall" in lattice.model_fields_set or lattice.structure is not None:
        return lattice
    family = lattice.printed_as.family if lattice.slicer else lattice.kind
    found = lattice.model_copy(update={"nodes_per_wall": nodes_of(family)})
    found.check_size()
    return found


def nodes_of(family: str) -> int:
    """Nodes inside a wall of a family of infill, or of parallel lines ("")."""
    return THREE if family in WITH_THREE else EIGHT if family else TWELVE
