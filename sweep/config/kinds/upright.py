"""A lattice that is pressed along its cells: numbers of quads, and what cannot stand upright."""

from typing import Any

from sweep.config.kinds.cells import TIED, Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.direction import WHERE
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.table import Given, RefusedError, keys_of
from sweep.config.network import network_of
from sweep.constants import TO_MM

NODES = 5  # inside a wall: six quads across
MOST_NODES = 20_000  # with six unknowns each
MOST_IMPERFECTION = 1.0  # in wall thicknesses: a bow should start a buckle, not be one


def across(made: Lattice) -> Lattice:
    """The lattice without what only a crush along the cells uses.

    It is one of perhaps very many: all share the set of their keys.
    """
    unused: dict[str, Any] = {"layers": None, "symmetry": "none", "imperfection_seed": None}
    if isinstance(made, CustomStructure):
        unused["imperfection"] = 0.0
    return type(made).model_construct(keys_of(type(made)), **(dict(made) | unused))


def upright(made: Lattice, given: Given) -> Lattice:
    """The lattice with its numbers of quads; refused if there are too many, or no mirror planes."""
    from sweep.design.period import own_parts
    from sweep.design.upright_plan import layers_of, mirror_fault, most_layers, plan_of, quads_along

    _check(made)
    changes: dict[str, Any] = {}
    if isinstance(made, Cells | Drawn) and "nodes_per_wall" not in given:
        changes["nodes_per_wall"] = NODES
    if made.imperfection == 0.0:
        changes["imperfection_seed"] = None
    meshed, network = made.model_copy(update=changes), network_of(made)
    quarter = made.symmetry == "quarter"
    if quarter and (fault := mirror_fault(network)):
        raise RefusedError("lattice.symmetry", "quarter", f'"none", as {fault}')
    plan = plan_of(network, quarter)
    most = most_layers(plan.thickness, made.depth)
    if most < 1:
        raise _too_low(made, float(plan.thickness.max()))
    along = quads_along(plan, quads_wanted(meshed))
    layers = given.get("layers") or layers_of(plan, along, made.depth)
    points, walls = own_parts(network) if made.tied else (len(plan.points), len(plan.walls))
    _check_nodes(meshed, points + int((along[:walls] - 1).sum()), layers)
    if layers > most:
        allowed = f"at most {most} here, as quads are no lower than walls are thick"
        raise RefusedError("lattice.layers", layers, allowed)
    return meshed.model_copy(update={"layers": layers})


def quads_wanted(made: Lattice) -> Any:
    """Number of quads along a whole wall: one for all walls, or (w,) of those of a file."""
    if isinstance(made, Drawn):
        return made.network.pieces(made.nodes_per_wall + 1)
    if not isinstance(made, CustomStructure):
        return made.nodes_per_wall + 1
    import numpy as np

    return np.array(made.structure.pieces)


def _check(made: Lattice) -> None:
    if made.endless:
        raise RefusedError("lattice.boundary", "periodic", f'"free" {WHERE}')
    if made.tied and made.symmetry == "quarter":
        raise RefusedError("lattice.symmetry", "quarter", f'"none" {TIED}')
    if made.imperfection > MOST_IMPERFECTION:
        allowed = f"at most {MOST_IMPERFECTION:g}, in wall thicknesses, {WHERE}"
        raise RefusedError("lattice.imperfection", made.imperfection, allowed)
    if isinstance(made, Sliced):
        allowed = f"none {WHERE}: give kind and cells"
        raise RefusedError("lattice.slicer", made.slicer, allowed)
    if isinstance(made, CustomStructure) and (unfit := made.structure.beside_walls):
        allowed = f"a file without {', '.join(unfit)} {WHERE}: its walls stand on platens"
        raise RefusedError("lattice.file", made.file, allowed)


def _too_low(made: Lattice, thickest: float) -> RefusedError:
    """The error of a height below that of one quad, the thickness of the thickest wall, m."""
    allowed = f"at least the wall thickness, {TO_MM * thickest:.4g} mm here, {WHERE}"
    if isinstance(made, CustomStructure):
        return RefusedError("lattice.file", made.file, f"a depth_mm of {allowed}")
    return RefusedError("lattice.depth", made.depth, allowed)


def _check_nodes(made: Lattice, columns: int, layers: int) -> None:
    nodes = columns * (layers + 1)
    if nodes > MOST_NODES:
        causes = ("cells_x", "cells_y", "nodes_per_wall", "layers")
        values = {key: getattr(made, key, 0) or 0 for key in causes}
        key = max(values, key=lambda name: values[name])
        allowed = f"at most {MOST_NODES:,} nodes in all {WHERE}, {nodes:,} here"
        raise RefusedError(f"lattice.{key}", values[key], allowed)
