"""The finalists of a search: each simulated again on a finer mesh, and with other geometry.

The best of many designs often has a favourable error. Its value is therefore shown beside the value
with twice the elements. It also often lies on a narrow peak, such as walls that just do not exceed
an allowed force. Its spread over prints that deviate from the drawing is therefore shown too: walls
5 % thinner and thicker, and a quarter and four times the imperfection.
"""

from collections.abc import Iterable, Mapping
from typing import Any

from sweep.config.case import Case
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.specimen import WallLattice
from sweep.config.kinds.table import RefusedError
from sweep.ranking.spread import FINE
from sweep.running.beside.refinement import layers, mesh

WALLS = {"walls -5 %": 0.95, "walls +5 %": 1.05}
BOWS = {"imperfection / 4": 0.25, "imperfection x 4": 4.0}
COUNT = 3
ALIKE = 0.05  # relative difference in all numbers up to which two designs are one peak


def finalists(best: Iterable[Case]) -> list[Case]:
    """The first `COUNT` designs that differ by a choice, or by more than `ALIKE`."""
    designs: list[Case] = []
    for case in best:
        if len(designs) == COUNT:
            break
        if not any(_alike(case.axes, other.axes) for other in designs):
            designs.append(case)
    return designs


def _alike(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    return all(_near(one[key], other[key]) for key in one)


def _near(one: object, other: object) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= ALIKE * max(abs(one), abs(other))
    return one == other


def perturbed(design: Case) -> dict[str, Case]:
    """By name, the design with twice the elements, and with it other walls and imperfections.

    Plates that would have too many nodes keep their mesh; changes that do not fit the rest of a
    design are left out.
    """
    fine = _with(design, _elements(design.lattice, 2))
    base = fine or _with(design, _elements(design.lattice, 1)) or design
    variants = {FINE: fine}
    if isinstance(base.lattice, WallLattice):
        count = (2 if fine else 1) * (design.lattice.layers or 0)
        for name, by in WALLS.items():
            height = layers(base.lattice, count, by) if count else {}
            variants[name] = _with(base, base.lattice.thicker(by) | height)
        amount = base.lattice.imperfection
        bows = BOWS if amount else {}
        variants |= {name: _with(base, {"imperfection": by * amount}) for name, by in bows.items()}
    return {name: case for name, case in variants.items() if case}


def _elements(lattice: Lattice, ratio: int) -> dict[str, Any]:
    """`ratio` times the elements in every wall, whose thickness no longer follows from a mass or a
    share.
    """
    change = mesh(lattice, ratio)
    if not isinstance(lattice, WallLattice):
        return change
    return change | {
        "mass": None,
        "infill": lattice.infill if isinstance(lattice, Sliced) else None,
    }


def _with(design: Case, change: dict[str, Any]) -> Case | None:
    """The design with a change of its lattice, which labels it; None if the change does not fit."""
    try:
        finalist = design.changed(lattice=change)
    except RefusedError:
        return None
    lattice = finalist.lattice
    labels: dict[str, Any] = {
        "lattice.wall_thickness": lattice.wall_thickness,
        "lattice.imperfection": lattice.imperfection,
    }
    if "nodes_per_wall" in type(lattice).model_fields:
        labels["lattice.nodes_per_wall"] = lattice.value("nodes_per_wall")
    return finalist.model_copy(update={"axes": design.axes | labels})
