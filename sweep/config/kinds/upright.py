"""A lattice that is pressed along its cells: numbers of quads, and refusals of unsuitable walls."""

from typing import Any, TypeVar

from sweep.config.kinds.direction import WHERE
from sweep.config.kinds.specimen import TIED, Specimen, cause, check_imperfection
from sweep.config.kinds.table import Inputs, RefusedError
from sweep.constants import TO_MM
from sweep.numbers import at_least

NODES = 5  # inside a wall: six quads across
MOST_NODES = 20_000  # each with six unknowns
CAUSES = ("file", "cell_size", "infill", "cells_x", "cells_y", "nodes_per_wall", "layers", "depth")
S = TypeVar("S", bound=Specimen)


def upright(lattice: S, inputs: Inputs) -> S:
    """The lattice with its numbers of quads; refused if there are too many, or no mirror planes."""
    from sweep.design.period import own_parts
    from sweep.design.upright_plan import layers_of, mirror_fault, most_layers, plan_of, quads_along

    _check(lattice)
    changes: dict[str, Any] = {}
    if "nodes_per_wall" in type(lattice).model_fields.keys() - inputs:
        changes["nodes_per_wall"] = NODES
    if lattice.imperfection == 0.0:
        changes["imperfection_seed"] = None
    meshed, network = lattice.model_copy(update=changes), lattice.network
    quarter = lattice.symmetry == "quarter"
    if quarter and (fault := mirror_fault(network)):
        raise lattice.refusal("symmetry", f'"none", as {fault}')
    plan = plan_of(network, quarter)
    most = most_layers(plan.thickness, lattice.depth)
    if most < 1:
        raise _too_low(lattice, float(plan.thickness.max()))
    along = quads_along(plan, meshed.wall_quads)
    layers = inputs.get("layers") or layers_of(plan, along, lattice.depth)
    points, walls = (
        own_parts(network) if lattice.tied_sides else (len(plan.points), len(plan.walls))
    )
    _check_nodes(meshed, inputs, points + int((along[:walls] - 1).sum()), layers)
    if layers > most:
        allowed = f"at most {most} here, as quads are no lower than walls are thick"
        raise RefusedError("lattice.layers", layers, allowed)
    return meshed.model_copy(update={"layers": layers})


def _check(lattice: Specimen) -> None:
    if lattice.endless:
        raise lattice.refusal("boundary", f'"free" {WHERE}')
    if lattice.tied_sides and lattice.symmetry == "quarter":
        raise lattice.refusal("symmetry", f'"none" {TIED}')
    check_imperfection(lattice, WHERE)
    lattice.check_standing(WHERE)


def _too_low(lattice: Specimen, thickest: float) -> RefusedError:
    """The error for a height below the height of one quad, the thickness of the thickest wall,
    m.
    """
    of_file = "depth" in lattice.derived
    least = f"{at_least(TO_MM * thickest)} mm" if of_file else f"{at_least(thickest)} m"
    allowed = f"at least the wall thickness, {least} here, {WHERE}"
    if of_file:
        return lattice.refusal("file", f"a depth_mm of {allowed}")
    return lattice.refusal("depth", allowed)


def _check_nodes(lattice: Specimen, inputs: Inputs, columns: int, layers: int) -> None:
    nodes = columns * (layers + 1)
    if nodes > MOST_NODES:
        allowed = f"at most {MOST_NODES:,} nodes in all {WHERE}, {nodes:,} here"
        raise RefusedError(*cause(lattice, inputs, CAUSES), allowed)
