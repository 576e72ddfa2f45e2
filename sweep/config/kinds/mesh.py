"""Default number of elements of a wall: the cheapest mesh that ranks within 2 %.

`make mesh` measures it, in every column of a ranking, against 24 elements a wall: for nine of ten
designs the error is at most 2 %. Which families need more elements is measured, not derived; so is
the number for the parallel lines of a slicer, whose walls run from side to side.
"""

THREE, EIGHT, TWELVE = 2, 7, 11  # nodes between joints
WITH_THREE = ("square", "brick", "hex", "circle")  # families of infill for which three suffice


def nodes_of(family: str) -> int:
    """Nodes inside a wall of a family of infill, or of parallel lines ("")."""
    return THREE if family in WITH_THREE else EIGHT if family else TWELVE
