"""Energy and stroke of a crush up to an allowed force for which the summary has no column.

The number of specimens of a panel depends on the design, and so does the force of a specimen at
which the panel bears the allowed force. The stored curves give the answer for each design.
"""

from collections.abc import Mapping
from os import PathLike
from typing import Any

import numpy as np
from pandas import DataFrame

from sweep.loading_modes import has
from sweep.ranking.merit import AT_ALLOWED, STROKE_AT_ALLOWED, panel_in
from sweep.ranking.question import Question, in_si
from sweep.simulation.filter_class import without_blows
from sweep.simulation.up_to_force import absorbed_until, stroke_until

ROUND_OFF = 1e-9
FORCES = ("reaction_top_N", "reaction_bottom_N")
READ = ("top_displacement_m", *FORCES, "work_in_J", "time_s", "kinetic_J")
"""Columns of a curve from which energy and stroke are read."""
Cache = dict[tuple[str, float], tuple[float, float]]
"""Energy (J) and stroke (m) of a case by its id and a force (N)."""


def with_allowed(
    file: str | PathLike[str],
    summary: DataFrame,
    question: Question,
    cache: Cache | None = None,
) -> DataFrame:
    """The summary with energy and stroke up to the allowed force, where the question needs them.

    question: of the ranking. The columns are needed if it has an allowed force; NaN in rows that
    are no crush or have no curve. For a crush that stopped, they are the values so far. cache:
    values of earlier calls, which are not read again; new values are added.
    """
    from sweep.store.read import read_curves

    force, panel = question.allowed_force, question.panel
    of_panel = question.per == "panel"
    if force is None or (of_panel and panel is None):
        return summary
    limit = in_si(force, "N")
    crushes = has(summary, "driven")
    rows = summary[crushes]
    count = np.ones(len(rows))
    if of_panel and panel is not None:
        count = panel_in(rows, panel).specimens
    at = zip(rows["case_id"], limit / count, strict=True)
    keys = [(str(case_id), float(force)) for case_id, force in at]
    cache = {} if cache is None else cache
    new = [key for key in keys if key not in cache]
    forces = dict(new)
    curves = read_curves(file, forces, READ)
    cache |= {(k, forces[k]): reached(curve, forces[k]) for k, curve in curves} if new else {}
    values = [cache[key] for key in keys]
    added = summary.assign(**{AT_ALLOWED: np.nan, STROKE_AT_ALLOWED: np.nan})
    energies, strokes = np.array(values).reshape(-1, 2).T
    strokes = np.minimum(strokes, rows["stroke_m"])  # curves have single precision
    added.loc[crushes, [AT_ALLOWED, STROKE_AT_ALLOWED]] = np.column_stack([energies, strokes])
    return added


def reached(curve: Mapping[str, Any], force: float) -> tuple[float, float]:
    """Energy (J) and stroke (m) of a crush until a platen bears ``force`` (N).

    curve: the history of the crush, with at least its columns `READ`. With several cycles, the
    first one counts, and with a speed the forces behind the filter. NaN without rows.
    """
    travel, work = (np.asarray(curve[name], float) for name in ("top_displacement_m", "work_in_J"))
    if not len(travel):
        return float("nan"), float("nan")
    forces = without_blows(curve) if np.any(curve["kinetic_J"]) else curve
    top, bottom = (np.asarray(forces[name], float) for name in FORCES)
    end = int(np.argmax(travel >= travel.max() * (1.0 - ROUND_OFF))) + 1
    borne, work, travel = np.fmax(top, bottom)[:end], work[:end], travel[:end]
    return absorbed_until(force, borne, work), stroke_until(force, borne, travel)
