"""Elements of a wall by default."""

import pytest

from sweep.config.case import Case
from sweep.config.kinds.mesh import EIGHT, THREE, TWELVE
from sweep.config.kinds.table import RefusedError

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
    case = Case.of(lattice=keys)
    assert case.lattice.nodes_per_wall == nodes
    assert case.changed().case_id == case.case_id


@pytest.mark.parametrize("nodes", [0, 2, 23])
def test_a_given_number_is_kept(nodes):
    case = Case.of(lattice=dict(kind="kagome", **THIN, nodes_per_wall=nodes))
    assert case.lattice.nodes_per_wall == nodes


def test_along_the_cells_walls_have_quads():
    along = dict(mode="displacement", direction="out_of_plane")
    assert Case.of(lattice=dict(kind="kagome", **THIN), loading=along).lattice.nodes_per_wall == 5


def test_too_many_nodes_are_refused():
    lattice = dict(kind="triangle", cells_x=60, cells_y=60, width=1.0, height=1.0)
    with pytest.raises(RefusedError, match="at most 50,000 nodes in all"):
        Case.of(lattice=lattice)
