"""The design of a stored case, rebuilt from its row and from the config in the results file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from math import isnan, nan
from typing import TYPE_CHECKING, Any

from sweep.config.network import network_of
from sweep.design.network import relative_density
from sweep.export.errors import ExportError

if TYPE_CHECKING:
    from sweep.config.case import Case
    from sweep.config.kinds.lattice import Lattice
    from sweep.config.structures.structure import Structure
    from sweep.design.network import Network

HEAD = "lattice."
SIZES = ("width", "height", "depth", "wall_thickness")
COUNTS = ("cells_x", "cells_y")
FOLLOWING = ("mass", "infill", "file")  # the row has what follows from these keys
ALONG = "out_of_plane"
OF_A_SLICER = ("cells_x", "cells_y", "wall_thickness", "fill_distance")  # follow from its infill
SAME = 1e-6  # relative difference of two printed areas that are the same


@dataclass(frozen=True)
class Design:
    """What is printed. network : the drawing; grams : mass of one specimen; along : whether it is
    pressed along its cells.
    """

    name: str
    lattice: Lattice
    network: Network
    grams: float
    along: bool = False

    @property
    def depth(self) -> float:
        """Depth of the walls, m."""
        return self.lattice.depth

    @property
    def footprint(self) -> tuple[float, float]:
        """The sides of the area that is pressed, m."""
        width, height = self.lattice.outer_size
        return (width, height) if self.along else (width, self.depth)

    @property
    def extruded_grams(self) -> float | None:
        """Mass of one specimen as its slicer extrudes it, which budgets count; None without one."""
        if self.lattice.slicer is None:
            return None
        from sweep.design.lattice import counted_area

        return self.grams * counted_area(self.lattice.geometry) / self.network.printed_area

    @property
    def volume(self) -> float:
        """Mass / density, m^3: the printed area x the depth."""
        return self.network.printed_area * self.depth


def design_of(case: Case) -> Design:
    """The design of a case that need not have run."""
    from sweep.design.network import mass

    network = network_of(case.lattice)
    kilograms = mass(network, case.lattice.depth, case.material.density)
    along = case.loading.direction == ALONG
    return _printable(Design(case.case_id, case.lattice, network, 1e3 * kilograms, along))


def stored_design(row: Mapping[str, Any], config: Mapping[str, Any]) -> Design:
    """The design of a row of a results file, whose config is in the file.

    A design whose printed area is not that of the row is refused: the config is of another sweep.
    """
    lattice = _lattice(row, config)
    network = network_of(lattice)
    found, stored = relative_density(network, lattice.outer_size), row["relative_density"]
    if not abs(found - stored) <= SAME * stored:
        raise _unknown(row)
    along = row.get("direction") == ALONG
    return _printable(Design(row["case_id"], lattice, network, row["mass_g"], along))


def _lattice(row: Mapping[str, Any], config: Mapping[str, Any]) -> Lattice:
    """The table `lattice`: that of the first case, what the config gives, what the row has."""
    from pydantic import ValidationError

    from sweep.config.kinds.lattice import Lattice

    if row.get("direction") == ALONG:
        row = _across(row, config)
    first = config.get("first_case", {}).get("lattice")
    if first is None:
        raise _unknown(row)
    tables = (config.get("base", {}), row)
    given = {k: v for table in tables for k, v in _keys(table).items() if v not in ("", None)}
    own = {key: float(row[f"{key}_m"]) for key in SIZES} | {key: int(row[key]) for key in COUNTS}
    values = {**first, **given, **own, **dict.fromkeys(FOLLOWING)} | _infill(row)
    laid = values["infill"] is not None
    known = {
        key: value
        for key, value in values.items()
        if key in Lattice.model_fields and not (laid and key in OF_A_SLICER)
    }
    try:
        return Lattice.model_validate(known | {"structure": _structure(known["structure"])})
    except ValidationError as error:
        raise _unknown(row) from error


def _across(row: Mapping[str, Any], config: Mapping[str, Any]) -> dict[str, Any]:
    """The row with the sizes that its lattice has across the cells.

    Along them `height_m` is the depth, and `depth_m` the height of the plan over all; over centre
    lines it is less by walls, or caps, whose thickness does not depend on it.
    """
    turned = {**row, "direction": "", "height_m": row["depth_m"], "depth_m": row["height_m"]}
    lattice = _lattice(turned, config)
    walls = lattice.outer_size[1] - lattice.height
    return {**turned, "height_m": row["depth_m"] - walls}


def _infill(row: Mapping[str, Any]) -> dict[str, Any]:
    """The keys of a pattern that a slicer lays, or of a family of infill."""
    share, name = row.get("infill_share", nan), row["lattice_kind"]
    if isnan(share):
        return dict.fromkeys(("slicer", "pattern", "fill_angle", "fill_distance")) | {"kind": name}
    return {"kind": "square", "pattern": name, "infill": float(share)}


def _structure(content: Mapping[str, Any] | None) -> Structure | None:
    """A custom structure; its lists become tuples only if it is read as JSON."""
    from sweep.config.structures.structure import Structure

    return Structure.model_validate_json(json.dumps(content)) if content else None


def _keys(table: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a table whose keys begin with ``lattice.``, by the rest of the key."""
    named = {str(key): value for key, value in table.items() if str(key).startswith(HEAD)}
    plain = {key: value.item() if hasattr(value, "item") else value for key, value in named.items()}
    return {key.removeprefix(HEAD): value for key, value in plain.items()}


def _printable(design: Design) -> Design:
    """A design that is a part, and no period of an endless lattice."""
    if design.lattice.endless:
        raise ExportError(
            f"case {design.name} is one period of an endless lattice (lattice.boundary), which is "
            "no part; allowed: .csv, .pvd, .vtu, .gif"
        )
    return design


def _unknown(row: Mapping[str, Any]) -> ExportError:
    return ExportError(
        f"the design of case {row['case_id']} does not follow from the config in this file, which "
        "is that of the last run: run the config of this case once more, then export"
    )
