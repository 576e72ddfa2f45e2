"""Default number of elements of a wall: the cheapest mesh that ranks within 2 %.

`make mesh` measures it, in every column of a ranking, against 24 elements a wall: for nine of ten
designs of every family the error is about 2 % at most. It is measured, not derived. For
hexagons and circles three are enough in a crush, but not when they are struck (docs/accuracy.md).
Thin rows of graded cells fold one by one: with eight elements a loose square with a loss absorbed
14 % too little, and another 32 % too much.
"""

EIGHT, TWELVE = 7, 11  # nodes between joints
WITH_EIGHT = ("square", "brick", "hex", "circle", "diamond")
"""Families of infill for which eight elements a wall suffice; others, drawings, and parallel lines,
whose walls run from side to side, have twelve."""


def nodes_of(family: str, graded: bool = False) -> int:
    """Nodes inside a wall of a family of infill, of parallel lines ("") or of a drawing; graded:
    whether walls at the top are thicker or thinner than at the bottom.
    """
    return EIGHT if family in WITH_EIGHT and not graded else TWELVE
