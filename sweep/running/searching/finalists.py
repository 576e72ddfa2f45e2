"""The finalists of a search: each simulated again on a finer mesh, and with other geometry.

The best of many designs often has a favourable error. Its value is therefore shown beside that on
twice the elements. It also often stands on a narrow peak, such as walls that just do not exceed an
allowed force. Its spread over prints that miss the drawing is therefore shown too: walls 5 %
thinner and thicker, and a quarter and four times the imperfection.
"""

from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import ValidationError

from sweep.config.case import Case, given
from sweep.config.lattice_table import Lattice
from sweep.config.network import network_of
from sweep.design.upright_plan import most_layers
from sweep.ranking.spread import FINE
from sweep.running.beside.spread import Corner

WALLS = {"walls -5 %": 0.95, "walls +5 %": 1.05}
BOWS = {"imperfection / 4": 0.25, "imperfection x 4": 4.0}
COUNT = 3
GIVEN = (
    *("slicer", "pattern", "fill_angle", "fill_multiline", "perimeters", "layer_height", "nozzle"),
    *("width", "height", "depth", "nodes_per_wall", "imperfection"),
)
"""Keys of a lattice that a slicer lays, beside those of the line width and the share."""

ALIKE = 0.05  # relative difference in all numbers up to which two designs are one peak


def finalists(best: Iterable[Case], count: int = COUNT) -> list[Case]:
    """The first designs that differ from one another by a choice, or by more than `ALIKE`."""
    found: list[Case] = []
    for case in best:
        if len(found) == count:
            break
        if not any(_alike(case.axes, other.axes) for other in found):
            found.append(case)
    return found


def _alike(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    return all(_near(one[key], other[key]) for key in one)


def _near(one: object, other: object) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= ALIKE * max(abs(one), abs(other))
    return one == other


def perturbed(design: Case) -> list[Corner]:
    """The design with twice the elements, and so with other walls and imperfections.

    Plates that would have too many nodes then keep their mesh; changes that do not fit the rest of
    a design are left out.
    """
    fine = _with(design, _with_elements(design.lattice, 2))
    base = _with_elements(design.lattice, 2 if fine else 1)
    found = {FINE: fine}
    if base.structure is None:
        found |= {name: _with(design, _printed(base, by)) for name, by in WALLS.items()}
        for name, by in BOWS.items() if base.imperfection else ():
            bent = base.model_copy(update={"imperfection": by * base.imperfection})
            found[name] = _with(design, bent)
    return [Corner(name, case) for name, case in found.items() if case]


def _printed(lattice: Lattice, by: float) -> Lattice:
    """The lattice with walls `by` times as thick in the same places, and perimeters if a slicer
    lays both: it extrudes wider lines, at a share of infill that keeps their distance.
    """
    if lattice.slicer is None:
        return lattice.model_copy(update={"wall_thickness": by * lattice.wall_thickness})
    known = {key: getattr(lattice, key) for key in GIVEN}
    wider = given(lattice.line_width) + (by - 1.0) * lattice.line
    return Lattice(**known | {"line_width": wider, "infill": by * given(lattice.infill)})


def _with_elements(lattice: Lattice, ratio: int) -> Lattice:
    """`ratio` times the elements in every wall, whose thickness no longer follows from a mass or a
    share, and as many times the layers of plates.
    """
    layers = None if lattice.layers is None else ratio * lattice.layers
    if lattice.structure is not None:
        pieces = tuple(ratio * n for n in lattice.structure.pieces)
        finer = lattice.structure.model_copy(update={"subdivide": pieces})
        return lattice.model_copy(update={"structure": finer, "layers": layers})
    nodes = ratio * (lattice.nodes_per_wall + 1) - 1
    change = {"nodes_per_wall": nodes, "mass": None, "layers": layers}
    if lattice.slicer is None:
        change["infill"] = None
    return lattice.model_copy(update=change)


def _with(design: Case, lattice: Lattice) -> Case | None:
    """The design with another lattice, labelled by what differs; None if that does not fit.

    Layers of plates are at most as many as leave quads as high as walls are thick.
    """
    if lattice.layers is not None:
        most = most_layers(network_of(lattice).wall_thickness, lattice.depth)
        lattice = lattice.model_copy(update={"layers": max(min(lattice.layers, most), 1)})
    labels = {
        "lattice.nodes_per_wall": lattice.nodes_per_wall,
        "lattice.wall_thickness": lattice.wall_thickness,
        "lattice.imperfection": lattice.imperfection,
    }
    try:
        return design.changed(lattice=lattice, axes=design.axes | labels)
    except ValidationError:
        return None
