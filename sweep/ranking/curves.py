"""Energy and stroke of a crush up to an allowed force that no column of the summary has.

The number of specimens of a panel depends on the design, and so does the force of a specimen at
which the panel bears the allowed one. The stored curves have the answer for each.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from sweep.ranking.merit import AT_ALLOWED, in_si, panel_specimens
from sweep.result import Status
from sweep.simulation.until import absorbed_until

if TYPE_CHECKING:
    from pandas import DataFrame

ROUND_OFF = 1e-9


def with_allowed(
    file: str | PathLike[str], summary: DataFrame, question: Mapping[str, Any]
) -> DataFrame:
    """The summary with energy and stroke up to the allowed force, where the question needs them.

    question : keyword arguments of `rank`. The columns are needed if it has an allowed force; NaN
    in rows that are no finished crush.
    """
    from sweep.store.read import read_cases

    force, panel = question.get("allowed_force"), question.get("panel")
    of_panel = question.get("per") == "panel"
    if force is None or (of_panel and panel is None):
        return summary
    limit = in_si(force, "N")
    wanted = (summary["loading_mode"] == "displacement") & (summary["status"] == Status.CONVERGED)
    rows = summary[wanted]
    count = np.ones(len(rows)) if panel is None or not of_panel else panel_specimens(rows, panel)
    curves = (case.history for case in read_cases(file, rows["case_id"], shapes=False))
    found = [reached(*pair) for pair in zip(curves, limit / count, strict=True)]
    added = summary.assign(**{AT_ALLOWED: np.nan, "stroke_at_allowed_m": np.nan})
    added.loc[wanted, [AT_ALLOWED, "stroke_at_allowed_m"]] = np.array(found).reshape(-1, 2)
    return added


def reached(curve: DataFrame, force: float) -> tuple[float, float]:
    """Energy (J) and stroke (m) of a crush until a platen bears ``force`` (N).

    curve : the history of the crush. Of several cycles, the first one counts.
    """
    travel = curve["top_displacement_m"].to_numpy()
    end = int(np.argmax(travel >= travel.max() * (1.0 - ROUND_OFF))) + 1
    borne = np.fmax(curve["reaction_top_N"], curve["reaction_bottom_N"]).to_numpy()[:end]
    work = curve["work_in_J"].to_numpy()[:end]
    return absorbed_until(force, borne, work), absorbed_until(force, borne, travel[:end])
