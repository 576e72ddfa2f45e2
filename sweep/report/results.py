"""The results of a sweep for a Python session or a notebook: table, curves, shapes, pictures."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sweep.numbers import counted
from sweep.ranking.curves import with_allowed
from sweep.ranking.question import Question, check_units
from sweep.ranking.rank import answer
from sweep.report.publish import case_figures, ranking_figures
from sweep.result import Status
from sweep.store.read import read_case, read_frames, read_history, read_summary

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from pandas import DataFrame, Series

    from sweep.config.case import Case

SHARPNESS = 110  # dots per inch in a notebook


class Picture:
    """A `figure` of matplotlib, which a notebook shows and `save` writes."""

    def __init__(self, figure: Figure) -> None:
        self.figure = figure

    def save(self, path: str | Path) -> Path:
        """Write the picture; the ending of the name says how (.png, .pdf, .svg)."""
        self.figure.savefig(path, bbox_inches="tight")
        return Path(path)

    def _repr_png_(self) -> bytes:
        drawn = io.BytesIO()
        self.figure.savefig(drawn, format="png", dpi=SHARPNESS, bbox_inches="tight")
        return drawn.getvalue()


class Results:
    """The finished cases of a sweep in the results file `path`, in the order of the sweep.

    ids : of the cases; None: all cases of the file. question : keyword arguments of `ranked` with
    which `plot` compares designs.
    """

    def __init__(
        self,
        path: str | Path,
        ids: Sequence[str] | None = None,
        question: Mapping[str, Any] | None = None,
    ) -> None:
        self.path = Path(path)
        self._ids = ids
        self._question = Question(**(question or {}))

    @cached_property
    def table(self) -> DataFrame:
        """A row for each finished case: design, status, all columns of the summary."""
        summary = read_summary(self.path)
        if self._ids is None:
            return summary
        place = {case_id: k for k, case_id in enumerate(self._ids)}
        rows = summary[summary["case_id"].isin(list(place))]
        return rows.sort_values("case_id", key=lambda ids: ids.map(place), ignore_index=True)

    @property
    def failed(self) -> DataFrame:
        """The rows that are not converged; their `message` says why."""
        return self.table[self.table["status"] != Status.CONVERGED]

    def rank(self, **question: Any) -> DataFrame:
        """The best designs by what the config asks for; question : arguments of `crumple.rank`, in
        place of these. Numbers need their units, such as budget="25 g".
        """
        given = {name: question.get(name) for name in ("budget", "panel", "allowed_force")}
        check_units(given | dict(question.get("require") or {}))
        full_question = Question(**self._question._asdict() | question)
        return answer(with_allowed(self.path, self.table, full_question), full_question).table

    def case(self, case: int | str) -> Case:
        """A case with all of its parameters, as it was computed; `crumple.simulate` runs it again.

        case : row of the table, or its id.
        """
        return read_case(self.path, self._row(case)["case_id"])

    def curve(self, case: int | str) -> DataFrame:
        """The history of a case: a row per stored step. case : row of the table, or its id."""
        return read_history(self.path, self._row(case)["case_id"])

    def shapes(self, case: int | str) -> dict[str, np.ndarray]:
        """The stored shapes of a case, the arrays of `Result.frames`."""
        return read_frames(self.path, self._row(case)["case_id"])

    def plot(self, case: int | str | None = None, what: str | None = None) -> Picture:
        """A picture of one case, "force" (the first), "energies" or "shapes".

        Without a case: of all designs, such as "absorption" over mass.
        """
        if case is None:
            figures = dict(ranking_figures(str(self.path), self.table, self._question))
        else:
            figures = dict(case_figures(str(self.path), self._row(case)))
        if not figures:
            raise ValueError("there is nothing to draw")
        if what is not None and what not in figures:
            raise ValueError(f'no picture "{what}"; there are {", ".join(figures)}')
        return Picture(figures[what] if what else next(iter(figures.values())))

    def _row(self, case: int | str) -> Series:
        """The row with a number, counted from 0, or with an id."""
        table = self.table
        if isinstance(case, str):
            rows = table[table["case_id"].str.startswith(case)]
            if len(rows) != 1:
                raise KeyError(f'"{case}" begins {len(rows)} ids of {len(table)}')
            return rows.iloc[0]
        if not 0 <= case < len(table):
            raise IndexError(f"no case {case}; allowed: 0 to {len(table) - 1}, or an id")
        return table.iloc[case]

    def __len__(self) -> int:
        return len(self.table)

    def __repr__(self) -> str:
        counts = f"{counted(len(self.table), 'case')}, {len(self.failed)} failed"
        return f"Results of {counts}, in {self.path}"

    def _repr_html_(self) -> str:
        return f"<p>{self!r}</p>{self.table.to_html(max_rows=20, max_cols=12)}"
