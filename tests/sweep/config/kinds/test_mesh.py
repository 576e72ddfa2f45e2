"""Elements of a wall by default."""

import pytest

from sweep.config.case import Case
from sweep.config.kinds.mesh import EIGHT, THREE, TWELVE

THIN = {"wall_thickness": 0.4e-3}
SLICED = {"slicer": "prusa", "infill": 0.2, "width": 25e-3, "height": 25e-3}


COARSE, FINE = ("square", "brick", "hex", "circle"), ("diamond", "reentrant", "triangle", "kagome")


@pytest.mark.parametrize(
    ("keys", "nodes"),
    [
        *(({"kind": kind} | THIN, THREE) for kind in COARSE),
        *(({"kind": kind} | THIN, EIGHT) for kind in FINE),
        *((SLICED | {"pattern": pattern}, THREE) for pattern in ("grid", "honeycomb")),
        *((SLICED | {"pattern": pattern}, EIGHT) for pattern in ("triangles", "stars")),
        (SLICED | {"pattern": "alignedrectilinear"}, TWELVE),
    ],
)
def test_patterns_have_what_they_need(keys, nodes):
    case = Case.of(lattice=keys)
    assert case.lattice.nodes_per_wall == nodes
    assert case.changed().case_id == case.case_id


def test_a_given_number_is_kept():
    for nodes in (0, 23):
        case = Case.of(lattice=dict(kind="kagome", **THIN, nodes_per_wall=nodes))
        assert case.lattice.nodes_per_wall == nodes


def test_along_the_cells_walls_have_quads():
    along = dict(mode="displacement", direction="out_of_plane")
    assert Case.of(lattice=dict(kind="kagome", **THIN), loading=along).lattice.nodes_per_wall == 5
