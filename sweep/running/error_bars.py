"""Error bars: every design is simulated again on another mesh, and again with longer steps.

These two companions are ordinary cases, in a results file of their own beside that of the sweep:
`armor.companions.h5` beside `armor.h5`. The difference between a design and each companion is
extrapolated to the limit of fine meshes or short steps at first order; the two errors are added:

    error = sum |value - companion's value| h / |H - h|

h, H: size of an element or a step of the design and of the companion. The other mesh has half the
elements, or twice as many if half are too few: walls of two elements buckle and touch in another
way. First order is assumed because walls touch and snap; smooth scenes converge faster.

An estimate from two sizes is no bound. It sees a buckling branch that only one of the two follows,
but not a branch that only finer meshes or shorter steps would follow.
"""

import os
from collections.abc import Mapping, Sequence
from math import isnan, nan
from pathlib import Path
from typing import Any, NamedTuple

from sweep.config.case import Case
from sweep.config.grid import Config, expand
from sweep.config.lattice_table import Lattice
from sweep.config.tables import Solver
from sweep.result import ABSORBED_AT, Status, error_column
from sweep.running.dask_graph import Simulate
from sweep.running.progress import tell
from sweep.running.provenance import config_text, describe_run
from sweep.running.sweep import run_sweep
from sweep.store.read import ONLY_MISSING, Rerun, exists, finished_ids, read_summary
from sweep.store.write import Writer

FEWEST = 3  # elements per wall of the mesh of a companion
PEAKS = ("peak_force_N", "peak_force_at_densification_N", "peak_force_until_packed_N")
HEADLINE = (
    "absorbed_energy_J",
    "absorbed_energy_at_densification_J",
    "absorbed_energy_until_packed_J",
    "returned_energy_J",
    "specific_absorption_J_per_g",
    "plateau_stress_Pa",
    "plateau_stress_iso_Pa",
    "densification_strain",
    "packing_strain",
    "efficiency",
    *PEAKS,
    "peak_strain",
    "peak_deceleration_m_per_s2",
    "stroke_left_m",
    "rebound_share",
)
"""Columns with an error bar, besides the energies up to allowed forces."""

Rows = Mapping[str, Mapping[str, Any]]
"""Rows of a summary by case id."""


class Companion(NamedTuple):
    """A case, and the factor h / |H - h| from the difference of results to the error."""

    case: Case
    weight: float


def companions(design: Case) -> list[Companion]:
    """The design on another mesh, and with longer steps."""
    lattice, mesh = _remeshed(design.lattice)
    solver, steps = _longer_steps(design.solver)
    return [
        Companion(_labelled(design.model_copy(update={"lattice": lattice})), mesh),
        Companion(_labelled(design.model_copy(update={"solver": solver})), steps),
    ]


def _labelled(case: Case) -> Case:
    """The case, labelled by its mesh and its steps, in which companions differ."""
    step = "time_step" if case.solver.load_steps is None else "load_steps"
    numerics = {
        "lattice.nodes_per_wall": case.lattice.nodes_per_wall,
        f"solver.{step}": getattr(case.solver, step),
    }
    return case.model_copy(update={"axes": numerics})


def _remeshed(lattice: Lattice) -> tuple[Lattice, float]:
    """Half the elements per wall, or twice as many if half are too few; the factor to the error."""
    structure = lattice.structure
    pieces = (lattice.nodes_per_wall + 1,) if structure is None else structure.pieces
    fine = min(pieces) >= 2 * FEWEST
    others = tuple(n // 2 if fine else 2 * n for n in pieces)
    weight = max(other / abs(n - other) for n, other in zip(pieces, others, strict=True))
    if structure is None:
        return lattice.model_copy(update={"nodes_per_wall": others[0] - 1}), weight
    remeshed = structure.model_copy(update={"subdivide": others})
    return lattice.model_copy(update={"structure": remeshed}), weight


def _longer_steps(solver: Solver) -> tuple[Solver, float]:
    """Half as many steps, or two instead of a single one; the factor to the error.

    The error of one step grows with its length to the power order + 1 of the integrator.
    """
    count = other = solver.load_steps
    ratio = 2.0
    if count is not None:
        other = count // 2 if count > 1 else 2
        ratio = count / other
    order = 1 if solver.integrator == "backward_euler" else 2
    scales = {"time_step": ratio, "arc_length": ratio, "step_error": ratio ** (order + 1)}
    values = {key: getattr(solver, key) for key in scales}
    scaled = {key: scales[key] * value for key, value in values.items() if value is not None}
    return solver.model_copy(update=scaled | {"load_steps": other}), 1.0 / abs(ratio - 1.0)


def companions_file(out: str | os.PathLike[str]) -> Path:
    """The results file of the companions of the designs in `out`."""
    return Path(out).with_suffix(".companions.h5")


def companions_beside(
    designs: Sequence[Case], out: str | os.PathLike[str], rerun: Rerun = ONLY_MISSING
) -> dict[str, Case]:
    """Companions of all designs by their id, without those that are cases of the sweep itself."""
    found = {c.case.case_id: c.case for design in designs for c in companions(design)}
    there = finished_ids(out, rerun._replace(failed=False)) | {case.case_id for case in designs}
    return {case_id: case for case_id, case in found.items() if case_id not in there}


def add_error_bars(
    sweep: Config | Sequence[Case],
    out: str | os.PathLike[str],
    workers: int = 2,
    scheduler: str | None = None,
    rerun: Rerun = ONLY_MISSING,
    simulate: Simulate | None = None,
) -> int:
    """Compute error bars of the converged designs of a sweep; return how many designs have none.

    Runs the missing companions. The error of a design is NaN if a companion failed or is of another
    version of the model. The arguments are those of `run_sweep`.
    """
    cases = expand(sweep) if isinstance(sweep, Config) else sweep
    beside, rows = companions_file(out), _converged(out)
    designs = [case for case in cases if case.case_id in rows]
    others = companions_beside(designs, out, rerun)
    if others.keys() - finished_ids(beside, rerun):
        tell(f"error bars of {len(designs)} designs: {len(others)} companions, in {beside}")
        run_sweep(list(others.values()), beside, workers, scheduler, rerun, simulate)
    rows |= _converged(beside) if exists(beside) else {}
    bars = {design.case_id: error_bars(design, rows) for design in designs}
    labels = {case.case_id: {**case.axes, **bars.get(case.case_id, {})} for case in cases}
    with Writer(out, labels, describe_run(config_text(sweep, cases[0]))) as writer:
        writer.fold()
    without = sum(all(map(isnan, bar.values())) for bar in bars.values())
    if without:
        tell(f"{without} of {len(designs)} designs have no error bar: crumple status {beside}")
    return without


def error_bars(design: Case, rows: Rows) -> dict[str, float]:
    """Error columns of a design; `rows`: all rows of converged cases.

    NaN if a companion is missing or of another version of the model. The peak force of a sudden
    load belongs to a wave: it grows as steps get shorter, and has no error bar.
    """
    own = rows[design.case_id]
    names = [name for name in own if name in HEADLINE or ABSORBED_AT.fullmatch(name)]
    others = [(c.weight, rows.get(c.case.case_id, {})) for c in companions(design)]
    version = own["model_version"]
    found = [(w, row if row.get("model_version") == version else {}) for w, row in others]
    bars = {
        name: sum(weight * abs(own[name] - other.get(name, nan)) for weight, other in found)
        for name in names
    }
    unsettled = PEAKS if design.loading.mode == "force" else ()
    return {error_column(name): nan if name in unsettled else bars[name] for name in names}


def _converged(file: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """Rows of the converged cases of a results file, by their id."""
    summary = read_summary(file)
    rows = summary[summary["status"] == Status.CONVERGED].to_dict("records")
    return {row["case_id"]: row for row in rows}
