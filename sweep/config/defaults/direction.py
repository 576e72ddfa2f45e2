"""The direction in which a lattice is pressed: across its cells, in the plane, or along them.

Along the cells the lattice is extruded to `lattice.depth`, which is then the height pressed, and
its walls are plates (`scene.plates`). Keys that a direction does not use get their defaults, so
that equal physics has an equal id; what cannot work along the cells is refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sweep.config.lattice_table import Lattice
from sweep.config.material_table import Material
from sweep.config.network import network_of
from sweep.config.tables import Damping, Loading, Solver, refusal
from sweep.constants import TO_MM

ALONG = "out_of_plane"
WHERE = f'if loading.direction is "{ALONG}"'
NODES = 5  # inside a wall: six quads across
MOST_NODES = 20_000  # with six unknowns each
TIME_LIMIT = 3600.0  # s
MAX_ITERATIONS = 300  # of one minimisation: where walls snap, 60 to 200 are common
MODES = '"displacement" or "impact"'
PLATENS = '"glued", "clamped" or "contact"'
NOT_ACROSS: dict[str, Any] = {"layers": None, "symmetry": "none", "imperfection_seed": None}
"""Keys of the lattice that only a crush along the cells uses, with their values across them."""

UNUSED: dict[str, tuple[str, ...]] = {
    "material": ("plane", "poisson"),
    "solver": ("element", "joints", "bend_measure", "hessian"),
    "damping": ("mass", "stiffness", "relaxation_time"),
}
"""Keys without effect along the cells, whose walls are incompressible sheets in plane stress."""

PARTS = (
    *("supports", "loads", "prescribed", "pins", "springs", "masses"),
    *("floor_y_mm", "gravity_mm_s2", "initial_velocity_mm_s", "probes"),
)
"""Keys of the file of a structure that cannot be pressed along its walls."""
MOST_IMPERFECTION = 1.0  # in wall thicknesses: a bow should start a buckle, not be one


def is_along(loading: Loading) -> bool:
    """Whether the lattice is pressed along its cells, out of the plane of its drawing."""
    return loading.direction == ALONG


def height_pressed(lattice: Lattice, loading: Loading) -> float:
    """The height that a platen or a striker presses, m."""
    return lattice.depth if is_along(loading) else lattice.height


def footprint(lattice: Lattice, loading: Loading) -> tuple[float, float]:
    """Outer width and depth (m) of the area that is pressed."""
    width, height = lattice.outer_size
    return (width, height) if is_along(loading) else (width, lattice.depth)


def turned(tables: Mapping[str, Any], sound: bool) -> dict[str, Any]:
    """The tables that depend on the direction, completed; sound: whether the lattice is valid."""
    lattice, loading = tables["lattice"], tables["loading"]
    if is_along(loading):
        return _along(tables, sound)
    changes: dict[str, Any] = NOT_ACROSS
    if lattice.structure is not None:
        changes = {**changes, "imperfection": 0.0}
    same = all(getattr(lattice, key) == value for key, value in changes.items())
    return {} if same else {"lattice": lattice.model_copy(update=changes)}


def _along(tables: Mapping[str, Any], sound: bool) -> dict[str, Any]:
    """The tables of a crush along the cells; what does not go with it is refused."""
    loading, lattice = tables["loading"], tables["lattice"]
    _check_lattice(lattice)
    _check_material(tables["material"])
    if loading.mode not in ("displacement", "impact"):
        raise refusal("loading.mode", loading.mode, f"{MODES} {WHERE}", loading.says_mode)
    if tables["contact"].model == "position_based":
        raise refusal("contact.model", "position_based", f'"barrier" or "none" {WHERE}')
    damping: Damping = tables["damping"]
    if damping.model not in (None, "none"):
        raise refusal("damping.model", damping.model, f'"none" {WHERE}')
    solver: Solver = tables["solver"]
    settled = {
        name: tables[name].model_copy(update=_defaults(tables[name], name)) for name in UNUSED
    }
    settled["damping"] = settled["damping"].model_copy(update={"model": "none"})
    limits = {"time_limit": TIME_LIMIT, "max_iterations": MAX_ITERATIONS}
    unset = {key: limits[key] for key in limits if key not in solver.model_fields_set}
    settled["solver"] = settled["solver"].model_copy(update=unset)
    return settled | {"lattice": _meshed(lattice) if sound else lattice}


def _defaults(table: Any, name: str) -> dict[str, Any]:
    fields = type(table).model_fields
    return {key: fields[key].default for key in UNUSED[name]}


def _check_lattice(lattice: Lattice) -> None:
    if lattice.boundary != "free":
        raise refusal("lattice.boundary", lattice.boundary, f'"free" {WHERE}')
    if lattice.imperfection > MOST_IMPERFECTION:
        allowed = f"at most {MOST_IMPERFECTION:g}, in wall thicknesses, {WHERE}"
        raise refusal("lattice.imperfection", lattice.imperfection, allowed)
    if lattice.slicer is not None:
        raise refusal("lattice.slicer", lattice.slicer, f"none {WHERE}: give kind and cells")
    structure = lattice.structure
    if structure is not None:
        fields = type(structure).model_fields
        unfit = [key for key in PARTS if getattr(structure, key) != fields[key].default]
        if unfit:
            allowed = f"a file without {', '.join(unfit)} {WHERE}: its walls stand on platens"
            raise refusal("lattice.file", lattice.file, allowed)


def _check_material(material: Material) -> None:
    """A wall is a sheet of layers that all follow one law, elastic or relaxing."""
    for key in material.not_along:
        if value := getattr(material, key):
            raise refusal(f"material.{key}", value, f"none {WHERE}: its walls are elastic or relax")
    if material.bend == "fibres":
        raise refusal("material.bend", material.bend, f'"section" or "linear" {WHERE}')
    fit = "linear" if material.stretch == "linear" else "section"
    if material.bend != fit:
        why = f'{WHERE} and material.stretch is "{material.stretch}"'
        raise refusal("material.bend", material.bend, f'"{fit}" {why}')


def check_platen(loading: Loading) -> None:
    """Refuse platens that a direction does not have."""
    platen = loading.platen
    if is_along(loading) and platen not in (None, "glued", "clamped", "contact"):
        raise refusal("loading.platen", platen, f"{PLATENS} {WHERE}")
    if not is_along(loading) and platen == "clamped":
        allowed = '"contact", "glued" or "sliding" if loading.direction is "in_plane"'
        raise refusal("loading.platen", platen, allowed)


def quads_wanted(lattice: Lattice) -> Any:
    """Number of quads along a whole wall: one for all walls, or (w,) of a custom structure."""
    if lattice.structure is None:
        return lattice.nodes_per_wall + 1
    import numpy as np

    return np.array(lattice.structure.pieces)


def _meshed(lattice: Lattice) -> Lattice:
    """The lattice with its numbers of quads; refused if there are too many, or no mirror planes."""
    from sweep.design.upright_plan import layers_of, mirror_fault, most_layers, plan_of, quads_along

    changes: dict[str, Any] = {}
    if lattice.structure is None and "nodes_per_wall" not in lattice.model_fields_set:
        changes["nodes_per_wall"] = NODES
    if lattice.imperfection == 0.0:
        changes["imperfection_seed"] = None
    meshed, network = lattice.model_copy(update=changes), network_of(lattice)
    quarter = lattice.symmetry == "quarter"
    if quarter and (fault := mirror_fault(network)):
        raise refusal("lattice.symmetry", "quarter", f'"none", as {fault}')
    plan = plan_of(network, quarter)
    most = most_layers(plan.thickness, lattice.depth)
    if most < 1:
        raise _too_low(lattice, float(plan.thickness.max()))
    along = quads_along(plan, quads_wanted(meshed))
    layers = lattice.layers or layers_of(plan, along, lattice.depth)
    _check_nodes(meshed, len(plan.points) + int((along - 1).sum()), layers)
    if layers > most:
        allowed = f"at most {most} here, as quads are no lower than walls are thick"
        raise refusal("lattice.layers", layers, allowed)
    return meshed.model_copy(update={"layers": layers})


def _too_low(lattice: Lattice, thickest: float) -> Exception:
    """The error of a height below that of one quad, the thickness of the thickest wall, m."""
    allowed = f"at least the wall thickness, {TO_MM * thickest:.4g} mm here, {WHERE}"
    if lattice.structure is not None:
        return refusal("lattice.file", lattice.file, f"a depth_mm of {allowed}")
    return refusal("lattice.depth", lattice.depth, allowed)


def _check_nodes(lattice: Lattice, columns: int, layers: int) -> None:
    nodes = columns * (layers + 1)
    if nodes > MOST_NODES:
        values = {key: getattr(lattice, key) for key in ("cells_x", "cells_y", "nodes_per_wall")}
        values |= {"layers": lattice.layers or 0}
        key = max(values, key=lambda name: values[name])
        allowed = f"at most {MOST_NODES:,} nodes in all {WHERE}, {nodes:,} here"
        raise refusal(f"lattice.{key}", values[key], allowed)
