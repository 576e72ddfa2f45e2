"""Error bars: every design is simulated again on a coarser mesh, and again with longer steps.

These two companions are ordinary cases, in a results file of their own beside the results of the
sweep: `armor.companions.h5` beside `armor.h5`. With half the elements or half the steps they cost
less than the design. h, H: size of an element or a step of the design and of the companion, r = H /
h:

    error = sum (change^2 + usual^2)^(1/2) / |r - 1|,    change = value - companion's value
    correction = sum change / (r^p - 1)

`usual` is the median relative change of the design's columns times the value, since one column may
agree by chance. The error is extrapolated at first order because walls touch and snap. The
correction is an estimate of limit - value with p = 2 for meshes, about the order of `make mesh`,
and p = 1 for steps. Two designs are compared by the difference of their corrections: most of the
error is common to them.

An estimate from two sizes is no bound. It sees a buckling branch that only one of the two follows,
but not a branch that only finer meshes or shorter steps would follow.
"""

import os
from collections.abc import Mapping, Sequence
from math import hypot, isfinite, isnan, nan
from statistics import median
from typing import Any, NamedTuple

from sweep.columns import ABSORBED_AT, IN_CYCLE, correction_column, error_column
from sweep.config.case import Case
from sweep.config.grid import Config, sweep_of
from sweep.config.kinds.dead_load import DeadLoad
from sweep.ranking.unfinished import loaded
from sweep.running.beside.refinement import refined
from sweep.running.beside.run_beside import How, file_beside, run_beside
from sweep.running.progress import announce
from sweep.running.provenance import config_text, describe_run
from sweep.store.read import Rerun, exists, finished_ids, read_summary
from sweep.store.write import Writer

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
"""Columns with an error bar, besides the energies up to allowed forces and the energies of
cycles.
"""

FOLLOWING = (
    *("lost_energy_J", "lost_share", "lost_energy_J_per_g", "second_cycle_share"),
    "peak_deceleration_filtered_m_per_s2",
)
"""Columns that follow from others: they have an error bar, but no part in the usual change."""

Rows = Mapping[str, Mapping[str, Any]]
"""Rows of a summary by case id."""


class Companion(NamedTuple):
    """A case, the ratio H / h of its size to the size of the design, and the order p of the
    correction.
    """

    case: Case
    ratio: float
    order: int

    @property
    def weight(self) -> float:
        """The factor from the change of a value to its error, at first order."""
        return 1.0 / abs(self.ratio - 1.0)

    @property
    def correction(self) -> float:
        """The factor from the change of a value to limit - value."""
        return 1.0 / (self.ratio**self.order - 1.0)


def companions(design: Case) -> list[Companion]:
    """The design with half the elements per wall, and with half the steps; with twice as many if
    there is only one.
    """
    before, count = design.lattice.pieces, design.solver.load_steps
    meshed = refined(design, elements=0.5 if min(before) > 1 else 2.0)
    mesh = min(n / other for n, other in zip(before, meshed.lattice.pieces, strict=True))
    longer = refined(design, steps=0.5 if count is None or count > 1 else 2.0)
    steps = 2.0 if count is None else count / (longer.solver.load_steps or 1)
    return [
        Companion(_labelled(meshed), mesh, order=2),
        Companion(_labelled(longer), steps, order=1),
    ]


def _labelled(case: Case) -> Case:
    """The case, labelled by its mesh and its steps, in which companions differ."""
    step = "time_step" if case.solver.load_steps is None else "load_steps"
    numerics = {
        "lattice.nodes_per_wall": getattr(case.lattice, "nodes_per_wall", 0),
        f"solver.{step}": getattr(case.solver, step),
    }
    return case.model_copy(update={"axes": numerics})


def companions_beside(
    designs: Sequence[Case], out: str | os.PathLike[str], rerun: Rerun
) -> dict[str, Case]:
    """Companions of all designs by their id, except those that are cases of the sweep itself."""
    by_id = {c.case.case_id: c.case for design in designs for c in companions(design)}
    there = finished_ids(out, rerun._replace(failed=False)) | {case.case_id for case in designs}
    return {case_id: case for case_id, case in by_id.items() if case_id not in there}


def add_error_bars(
    sweep: Config | Sequence[Case],
    out: str | os.PathLike[str],
    how: How,
) -> int:
    """Compute error bars of the converged designs of a sweep; return how many designs have none.

    Runs the missing companions. The error of a design is NaN if a companion failed or was computed
    by another version of the model.
    """
    config = sweep_of(sweep)
    cases = config.cases
    beside, rows = file_beside(out, "companions"), _comparable(out)
    designs = [case for case in cases if case.case_id in rows]
    others = companions_beside(designs, out, how.rerun)
    what = f"error bars of {len(designs)} designs: {len(others)} companions"
    run_beside(others, beside, what, how)
    rows |= _comparable(beside) if exists(beside) else {}
    bars = {design.case_id: error_bars(design, rows) for design in designs}
    labels = {case.case_id: {**case.axes, **bars.get(case.case_id, {})} for case in cases}
    with Writer(out, labels, describe_run(config_text(config))) as writer:
        writer.fold()
    without = sum(all(map(isnan, bar.values())) for bar in bars.values())
    if without:
        announce(f"{without} of {len(designs)} designs have no error bar: crumple status {beside}")
    return without


def error_bars(design: Case, rows: Rows) -> dict[str, float]:
    """Error and correction columns of a design; `rows`: all rows of converged cases.

    NaN if a companion is missing or was computed by another version of the model. The peak force of
    a sudden load belongs to a wave: it grows as steps get shorter, and has no error bar.
    """
    own = rows[design.case_id]
    unsettled = PEAKS if isinstance(design.loading, DeadLoad) else ()
    names = [name for name in own if _has_bar(name)]
    errors = dict.fromkeys(names, 0.0)
    corrections = dict.fromkeys(names, 0.0)
    for companion in companions(design):
        row = rows.get(companion.case.case_id, {})
        other = row if row.get("model_version") == own["model_version"] else {}
        change = {name: own[name] - other.get(name, nan) for name in names}
        settled = {n: change[n] for n in names if n not in (*unsettled, *FOLLOWING)}
        usual = _median_share(settled, own)
        for name in names:
            errors[name] += companion.weight * hypot(change[name], usual * own[name])
            corrections[name] += companion.correction * change[name]
    for name in unsettled:
        errors[name] = corrections[name] = nan
    bars = {error_column(name): error for name, error in errors.items()}
    return bars | {correction_column(name): value for name, value in corrections.items()}


def _has_bar(name: str) -> bool:
    """Whether a column has an error bar."""
    derived = ABSORBED_AT.fullmatch(name) or IN_CYCLE.fullmatch(name)
    return name in (*HEADLINE, *FOLLOWING) or derived is not None


def _median_share(change: Mapping[str, float], own: Mapping[str, Any]) -> float:
    """Median of the changes as shares of the values, over columns with both; 0 if there are
    none.
    """
    shares = [abs(change[name] / own[name]) for name in change if own[name] != 0.0]
    numbers = [share for share in shares if isfinite(share)]
    return median(numbers) if numbers else 0.0


def _comparable(file: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """Rows of the loaded cases of a results file, by their id. Retries are left out: their steps or
    their imperfection differ from the numbers that a companion halves.
    """
    rows = loaded(read_summary(file))
    rows = rows[rows["retry"] == ""].to_dict("records")
    return {row["case_id"]: row for row in rows}
