"""Files for people: the ranking of a sweep as tables and figures, a case as pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pandas import concat

from sweep.report import design_map as charts, case_plots as plots
from sweep.ranking.accuracy import studies
from sweep.report.work_precision import work_precision
from sweep.report.markdown import markdown
from sweep.report.pattern_bars import panel_size, pattern_bars
from sweep.report.accuracy_tables import MARKS, accuracy_sheets, scene_title
from sweep.ranking.rank import rank
from sweep.report.probe_plots import probe_reactions
from sweep.report.sheets import Sheet, design_labels, legend, ranking_sheets
from sweep.store.read import read_frames, read_history, read_summary
from sweep.report.storyboard import headline, last_loaded

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame, Series

MAX_SCENES = 12  # drawn in one figure
MAX_WINNERS = 6
Named = Iterator[tuple[str, "Figure"]]


def publish_ranking(
    file: str, summary: DataFrame, question: Mapping[str, Any], folder: Path
) -> list[Path]:
    """Write a ranking as `ranking.md`, every design as `ranking.csv`, and the figures.

    question : the keywords of `rank`.
    """
    shown = rank(summary, **question)
    unlimited = question["budget"] and [inf]  # a budget, so that energy counts and not J/g
    ranking = rank(summary, **{**question, "budget": unlimited, "top": None})
    ranking.attrs["budgets_g"] = shown.attrs["budgets_g"]
    folder.mkdir(parents=True, exist_ok=True)
    text, table = folder / "ranking.md", folder / "ranking.csv"
    tables = f"{markdown(ranking_sheets(shown, summary))}\n{legend(shown)}\n"
    text.write_text(tables, encoding="utf-8")
    ranking.to_csv(table, index=False)
    figures = _sweep_figures(file, shown, ranking)
    return [text, table, *(plots.save(fig, folder / f"{name}.png") for name, fig in figures)]


def publish_accuracy(file: Path, case_ids: Iterable[str]) -> tuple[list[Sheet], list[Path]]:
    """Errors of the cases of an accuracy study, as sheets, and beside the results as files.

    The files: the sheets as Markdown, all columns as CSV, work-precision diagrams; nothing where no
    case has converged.
    """
    summary = read_summary(file)
    found = studies(file, summary[summary["case_id"].isin(list(case_ids))])
    titled = {scene_title(study, file.stem): study for study in found}
    sheets = [sheet for title, study in titled.items() for sheet in accuracy_sheets(study, title)]
    if not sheets:
        return [], []
    sheets[-1] = sheets[-1]._replace(notes=(MARKS,))
    text, table = file.with_suffix(".md"), file.with_suffix(".csv")
    text.write_text(markdown(sheets), encoding="utf-8")
    settings = [study.settings.assign(scene=title) for title, study in titled.items()]
    concat(settings, ignore_index=True).to_csv(table, index=False)
    figure = plots.blank(13.0, 3.6 * len(titled))
    work_precision(figure, titled)
    return sheets, [text, table, plots.save(figure, file.with_suffix(".png"))]


def publish_case(file: str, row: Series, folder: Path) -> list[Path]:
    """Draw one case: its force, its energies and six of its shapes, as far as it ran."""
    figures = _case_figures(file, row)
    return [plots.save(figure, folder / f"{name}.png") for name, figure in figures]


def _sweep_figures(file: str, shown: DataFrame, ranking: DataFrame) -> Named:
    """What to print by mass, by pattern, the trend with wall thickness, the winners' shapes."""
    pictures = {"absorption": "displacement", "sink": "force", "passed_on": "impact"}
    drawn = {
        name: _some_scenes(ranking[ranking["loading_mode"] == mode])
        for name, mode in pictures.items()
    }
    crushed = drawn["absorption"]
    for name, rows in drawn.items():
        if not rows.empty:
            figure = plots.blank(*_size(rows))
            charts.design_map(figure, rows)
            yield name, figure
    if len(crushed["lattice_kind"].unique()) > 1:
        figure = plots.blank(*panel_size(crushed))
        pattern_bars(figure, crushed)
        yield "patterns", figure
    if charts.has_trends(crushed):
        figure = plots.blank(*_size(crushed))
        charts.thickness_trends(figure, crushed)
        yield "wall_thickness", figure
    if winners := _winners(file, shown, ranking):
        figure = plots.blank(12.0, 2.6 * len(winners))
        plots.winners(figure, winners)
        yield "winners", figure


def _some_scenes(ranking: DataFrame) -> DataFrame:
    """Designs of as many scenes as fit into one figure."""
    return ranking[ranking["scene"].isin(ranking["scene"].unique()[:MAX_SCENES])]


def _size(ranking: DataFrame) -> tuple[float, float]:
    """Inches for a panel a scene, two a row, and a legend."""
    scenes = len(ranking["scene"].unique())
    return 5.0 * min(2, scenes) + 1.8, 4.2 * -(-scenes // 2)


def _winners(file: str, shown: DataFrame, ranking: DataFrame) -> dict[str, dict[str, Any]]:
    """Frames of the best of the crushed or struck designs, named by budget, scene and design."""
    first = shown[shown["loading_mode"] != "force"].drop_duplicates(["budget_g", "scene"])
    first = first.drop_duplicates("case_id").head(MAX_WINNERS)
    winners = {}
    for (_, row), design in zip(first.iterrows(), design_labels(first, ranking), strict=True):
        budget = f"up to {row['budget_g']:g} g, " if row["budget_g"] > 0.0 else ""
        if frames := read_frames(file, row["case_id"]):
            winners[f"{budget}{row['scene']}: {design}"] = frames
    return winners


def _case_figures(file: str, row: Series) -> Named:
    """Figures of what a case has left; none of a case that left nothing."""
    history, frames = read_history(file, row["case_id"]), read_frames(file, row["case_id"])
    if len(history) > 1:
        figure = plots.blank(8.0, 4.4)
        if row["loading_mode"] == "custom":
            probe_reactions(figure.subplots(), history, row)
        else:
            plots.force_displacement(figure.subplots(), history, row)
        yield "force", figure
        figure = plots.blank(8.0, 4.2)
        plots.energies(figure.subplots(), history, row)
        yield "energies", figure
    if frames:
        dead = row["loading_mode"] == "force"
        release = history["time_s"][last_loaded(history, row)] if dead else None
        drawn = headline(row).replace("\n", ", "), frames, release
        figure = plots.blank(*plots.shapes_size(*drawn))
        plots.deformed_shapes(figure, *drawn)
        yield "shapes", figure
