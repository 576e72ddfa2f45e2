"""The results of a sweep for a Python session or a notebook: table, curves, shapes, pictures."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from enum import Enum
from functools import cached_property
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pandas import DataFrame, Series

from sweep.argument_types import explained
from sweep.numbers import counted
from sweep.ranking.curves import with_allowed
from sweep.ranking.question import Quantity, Question, check_units
from sweep.ranking.rank import answer
from sweep.report.publish import case_figures, ranking_figures
from sweep.report.tables.html import html_table, paragraphs
from sweep.report.tables.legend import legend
from sweep.report.tables.sheets import ranking_sheets
from sweep.report.thumbnail import thumbnail
from sweep.result import Status
from sweep.store.errors import StoreError
from sweep.store.read import read_case, read_frames, read_history, read_runs, read_summary
from sweep.whole_file import whole

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from xarray import Dataset

    from sweep.config.case import Case

SHARPNESS = 110  # dots per inch in a notebook


class FromConfig(Enum):
    """The default of an argument: the value in the config."""

    FROM_CONFIG = "as in the config"

    def __repr__(self) -> str:
        return self.value


FROM_CONFIG = FromConfig.FROM_CONFIG


class Picture:
    """A `figure` of matplotlib, which a notebook shows and `save` writes."""

    def __init__(self, figure: Figure) -> None:
        self.figure = figure

    def save(self, path: str | Path) -> Path:
        """Write the picture; the ending of the name sets the format (.png, .pdf, .svg)."""
        with whole(Path(path)) as file:
            self.figure.savefig(file, bbox_inches="tight")
        return Path(path)

    def __repr__(self) -> str:
        titles = [axes.get_title("left") or axes.get_title() for axes in self.figure.axes]
        return f"<Picture of {', '.join(filter(None, titles)) or 'all designs'}>"

    def _repr_png_(self) -> bytes:
        drawn = io.BytesIO()
        self.figure.savefig(drawn, format="png", dpi=SHARPNESS, bbox_inches="tight")
        return drawn.getvalue()


class Results:
    """The finished cases of a sweep in the results file `path`, in the order of the sweep.

    ids: of the cases; None: all cases of the file. question: keyword arguments of `ranked` with
    which `plot` compares designs.
    """

    def __init__(
        self,
        path: str | PathLike[str],
        ids: Sequence[str] | None = None,
        question: Mapping[str, Any] | None = None,
    ) -> None:
        if not isinstance(path, str | PathLike):
            raise StoreError(f"{path!r} is no path; needed: the path of a results file")
        self.path = Path(path)
        self._ids = ids
        self.question = Question(**(question or {}))

    def __fspath__(self) -> str:
        return str(self.path)

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

    @explained
    def rank(  # noqa: PLR0913  every argument is a part of one question
        self,
        budget: Quantity | Sequence[Quantity] | FromConfig | None = FROM_CONFIG,
        panel: Sequence[Quantity] | FromConfig | None = FROM_CONFIG,
        by: str | FromConfig | None = FROM_CONFIG,
        top: int | FromConfig | None = FROM_CONFIG,
        allowed_force: Quantity | FromConfig | None = FROM_CONFIG,
        require: Mapping[str, Quantity | None] | FromConfig | None = FROM_CONFIG,
        per: str | FromConfig = FROM_CONFIG,
    ) -> DataFrame:
        """The best designs, by the question of the config as changed by the arguments.

        Arguments and table are the same as for `crumple.rank`; None drops the value of the config.
        Numbers need their units, such as budget="25 g".
        """
        every = Question(budget, panel, by, top, allowed_force, require, per)  # type: ignore[arg-type]
        changes = {name: v for name, v in every._asdict().items() if v is not FROM_CONFIG}
        quantities = {name: changes.get(name) for name in ("budget", "panel", "allowed_force")}
        check_units(quantities | dict(changes.get("require") or {}))
        question = self.question._replace(**changes)
        return answer(with_allowed(self.path, self.table, question), question).table

    @explained
    def case(self, case: int | str) -> Case:
        """A case with all of its parameters, as it was computed; `crumple.simulate` runs it again.

        case: row of the table, or its id.
        """
        return read_case(self.path, self._row(case)["case_id"])

    @explained
    def curve(self, case: int | str) -> DataFrame:
        """The history of a case: a row per stored step. case: row of the table, or its id."""
        return read_history(self.path, self._row(case)["case_id"])

    @explained
    def shapes(self, case: int | str) -> dict[str, np.ndarray]:
        """The stored shapes of a case, the arrays of `Result.frames`."""
        return read_frames(self.path, self._row(case)["case_id"])

    @explained
    def plot(self, case: int | str | None = None, what: str | None = None) -> Picture:
        """A picture of one case, "force" (the first), "energies" or "shapes".

        Without a case: of all designs, such as "absorption" over mass.
        """
        if case is None:
            figures = ranking_figures(str(self.path), self.table, self.question)
        else:
            figures = case_figures(str(self.path), self._row(case))
        others = []
        for name, figure in figures:
            if what in (None, name):
                return Picture(figure)
            others.append(name)
        if not others:
            raise ValueError("there is nothing to draw")
        raise ValueError(f'no picture "{what}"; there are {", ".join(others)}')

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

    @explained
    def report(self, out: str | Path | None = None) -> Path:
        """Write the results as one HTML page with sliders, as `crumple report` does; return it.

        out: the page, by default NAME.html beside the results. It has all cases of the file, and
        begins with the question of the config.
        """
        from sweep.export.page import export_page

        page = Path(out or self.path.with_suffix(".html"))
        return export_page(str(self.path), read_summary(self.path), self.question, page).file

    @explained
    def to_xarray(self, curves: Sequence[str] | str | bool = ()) -> Dataset:
        """The table as an `xarray.Dataset` along `case_id`; needs xarray (`crumple[xarray]`).

        curves: columns of `curve` to add, along `case_id` and `row`, NaN after the last row of a
        case; True: all of them. One that the table has too is called `history_...`. Keys of the
        grid are coordinates, so that `dataset.set_index(case_id=[...]).unstack()` makes them axes.
        Variables have their `units` and a `long_name`.
        """
        from sweep.report.arrays import dataset

        return dataset(self.path, self.table, curves)

    def __len__(self) -> int:
        return len(self.table)

    def __repr__(self) -> str:
        counts = f"{counted(len(self.table), 'case')}, {len(self.failed)} failed"
        return f"<Results of {counts}, in {self.path}>"

    def _repr_html_(self) -> str:
        """The ranking, with a drawing of each design."""
        head = f"<p>{escape(repr(self)[1:-1])}</p>"
        if len(self.failed) == len(self.table):
            return head
        source = with_allowed(self.path, self.table, self.question)
        ranking = answer(source, self.question)
        sheets = list(ranking_sheets(ranking, source))
        drawn = dict.fromkeys(case_id for sheet in sheets for case_id in sheet.cases)
        runs = read_runs(self.path, drawn)
        pictures = {run.case_id: thumbnail(run.frames) for run in runs}
        tables = "".join(html_table(sheet, pictures) for sheet in sheets)
        notes = paragraphs(legend(ranking).splitlines()) if len(ranking.table) else ""
        return f"{head}{tables}{notes}"
