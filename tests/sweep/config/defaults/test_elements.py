"""Elements of a wall by default."""

import pytest
from pydantic import ValidationError

from sweep.config.case import Case, Lattice, Loading
from sweep.config.defaults.elements import EIGHT, THREE, TWELVE

THIN = {"wall_thickness": 0.4e-3}
SLICED = {"slicer": "prusa", "infill": 0.2, "width": 25e-3, "height": 25e-3}


@pytest.mark.parametrize(
    ("keys", "nodes"),
    [
        *(({"kind": kind} | THIN, THREE) for kind in ("square", "brick", "hex", "circle")),
        *(
            ({"kind": kind} | THIN, EIGHT)
            for kind in ("diamond", "reentrant", "triangle", "kagome")
        ),
        *((SLICED | {"pattern": pattern}, THREE) for pattern in ("grid", "honeycomb")),
        *((SLICED | {"pattern": pattern}, EIGHT) for pattern in ("triangles", "stars")),
        (SLICED | {"pattern": "alignedrectilinear"}, TWELVE),
    ],
)
def test_patterns_have_what_they_need(keys, nodes):
    case = Case(lattice=Lattice(**keys))
    assert case.lattice.nodes_per_wall == nodes
    assert case.changed().case_id == case.case_id


@pytest.mark.parametrize("nodes", [0, 2, 23])
def test_a_given_number_is_kept(nodes):
    case = Case(lattice=Lattice(kind="kagome", **THIN, nodes_per_wall=nodes))
    assert case.lattice.nodes_per_wall == nodes


def test_along_the_cells_walls_have_quads():
    along = Loading(mode="displacement", direction="out_of_plane")
    assert Case(lattice=Lattice(kind="kagome", **THIN), loading=along).lattice.nodes_per_wall == 5


def test_too_many_nodes_are_refused():
    lattice = Lattice(kind="triangle", cells_x=60, cells_y=60, width=1.0, height=1.0)
    with pytest.raises(ValidationError, match="at most 50,000 nodes in all"):
        Case(lattice=lattice)
