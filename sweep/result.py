"""The result of one case: a status, a message, a row of numbers, curves and shapes.

Failure is a value: a case that does not finish is a `Result` with another status than `converged`,
a message that says what to try, and the curves and shapes up to that point. Nothing here computes
or opens a file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from sweep.columns import COLUMNS, TIED_SIDES, absorbed_energy_column, cycle_columns
from sweep.loading_modes import MODES

if TYPE_CHECKING:
    from sweep.config.case import Case


MODEL_VERSION = 26
"""Version of the model: raised by every change of the numbers that a case gives."""

LOADED = [name for name in COLUMNS if any(name in mode.columns for mode in MODES.values())]
"""Columns that only some loadings have."""

HOW_TO_RENEW = "crumple run CONFIG --renew computes older ones again"


class Status(StrEnum):
    """How a case ended. Only `converged` means that it ran to its end, in steps that resolve it.

    `slipped` is an answer too: the striker has lost the lattice, or the lattice has tipped
    over, so that the design has no place.
    """

    CONVERGED = "converged"
    STOPPED = "stopped"
    SLIPPED = "slipped"
    TIMED_OUT = "timed_out"
    UNRESOLVED = "unresolved"
    WORKER_DIED = "worker_died"


@dataclass(frozen=True, repr=False)
class Result:
    """The result of one case, converged or not.

    case: as it was computed; its row keeps it.
    summary: column -> float, int or str; names and units in `COLUMNS`.
    history: column -> float64 (rows,); names and units in `HISTORY_COLUMNS`.
    frames: `strain (f,)`, `time_s (f,)`, `position_m (f, n, 2)`, `plate_y_m (f, 2)` (surface of the
    lower and the upper platen; NaN: no platen; -inf: an endless lattice), `edges (m, 2)`,
    `edge_thickness_m (m,)`; in place of flat platens `striker_m (v, 2)`, x and y above the platen
    of an outline, and `base_m (2 v, 2)` of two. Of a crush along the cells, `position_m (f, n, 3)`,
    with z upwards, and `quads (m, 4)`, `quad_thickness_m (m,)` in place of edges.
    curable: True if the case stopped where other steps or another imperfection may help.
    """

    case: Case
    status: Status
    message: str = ""
    summary: Mapping[str, float | int | str] = field(default_factory=dict)
    history: Mapping[str, np.ndarray] = field(default_factory=dict)
    frames: Mapping[str, np.ndarray] = field(default_factory=dict)
    curable: bool = False

    def __repr__(self) -> str:
        why = f": {self.message}" if self.message else ""
        return f"<Result of {self.case!r}: {self.status.value}{why}>"

    @property
    def case_id(self) -> str:
        """The id of the case."""
        return self.case.case_id


def design_columns(case: Case) -> dict[str, float | int | str]:
    """The summary columns that are known before the case runs."""
    from sweep.config.kinds.printable import what_does_not_print
    from sweep.config.kinds.sliced import Sliced
    from sweep.config.kinds.sliced_sheet import SlicedSheet
    from sweep.config.slicer_settings import slicer_settings

    lattice, loading = case.lattice, case.loading
    return {
        "lattice_kind": lattice.name,
        "cells_x": lattice.cells_x,
        "cells_y": lattice.cells_y,
        "wall_thickness_m": lattice.wall_thickness,
        "infill_share": lattice.infill if isinstance(lattice, Sliced | SlicedSheet) else nan,
        "slicer_settings": str(slicer_settings(lattice) or ""),
        "does_not_print": what_does_not_print(lattice),
        "sides": sides_of(case),
        "direction": loading.direction,
        "width_m": lattice.width,
        "height_m": case.height,
        "depth_m": case.footprint[1],
        "outer_width_m": lattice.outer_size[0],
        "material": case.material.name,
        "material_modulus_Pa": case.material.modulus,
        "material_memory": case.material.inelasticity,
        "loading_mode": loading.mode,
        "platen": loading.platen,
        **loading.shape_columns,
        **dict.fromkeys(LOADED, nan) | loading.columns,
        "contact_model": case.contact.model,
        "model_version": MODEL_VERSION,
    }


def sides_of(case: Case) -> str:
    """The column `sides` of a case."""
    if not case.lattice.tied_sides:
        return "endless" if case.lattice.endless else "free"
    return f"{TIED_SIDES}, {'free' if case.widens else 'fixed'} period"


def failed_result(case: Case, status: Status, message: str) -> Result:
    """Result of a case without any measurement: its design, NaN for all measures, no curves."""
    measures = {name: nan for name in COLUMNS if name not in ("case_id", "status", "message")}
    measures |= {absorbed_energy_column(force): nan for force in case.loading.allowed_forces}
    cycles = case.loading.cycles
    for number in range(1, cycles + 1) if cycles > 1 else ():
        measures |= dict.fromkeys(cycle_columns(number), nan)
    counts = {"touched": 0, "max_crossings": 0, "steps": 0, "newton_iterations": 0}
    values = {**measures, **counts, "loaded": 0, "retry": "", **design_columns(case)}
    return Result(case, status, message, values)
