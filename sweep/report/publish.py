"""Writes the ranking of a sweep as tables and figures, and a case as pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pandas import DataFrame, Series, concat

from sweep.loading_modes import MODES, has
from sweep.numbers import budget_text, in_unit
from sweep.plain_text import csv_text
from sweep.ranking.accuracy import studies
from sweep.ranking.cushion import crush_of, drops
from sweep.ranking.merit import unequal_periods
from sweep.ranking.question import Question, RankError
from sweep.ranking.rank import answer
from sweep.ranking.ranking import Ranking
from sweep.report.figures import case_plots, cushion_plots, ranking_plots
from sweep.report.figures.base_plots import base_pressure
from sweep.report.figures.panel_piece import piece
from sweep.report.figures.pattern_bars import panel_size, pattern_bars
from sweep.report.figures.probe_plots import probe_reactions
from sweep.report.figures.shaded import cut_open
from sweep.report.figures.storyboard import design_and_scene, last_loaded
from sweep.report.figures.work_precision import work_precision
from sweep.report.tables.accuracy_tables import MARKS, accuracy_sheets, scene_title
from sweep.report.tables.design_text import design_labels
from sweep.report.tables.legend import legend
from sweep.report.tables.markdown import markdown
from sweep.report.tables.missing_notes import incomplete
from sweep.report.tables.sheet import Sheet
from sweep.report.tables.sheets import ranking_sheets
from sweep.report.tables.unfinished_notes import picture_note
from sweep.store.read import read_attributes, read_frames, read_history, read_summary
from sweep.whole_file import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MAX_SCENES = 12  # most scenes in one figure
MAX_WINNERS = 6
MAX_DRAWN = 40  # most bars with a drawing in one figure
Named = Iterator[tuple[str, "Figure"]]


def publish_ranking(
    file: str,
    summary: DataFrame,
    question: Question,
    folder: Path,
    drop_heights: Sequence[float] = (),
) -> list[Path]:
    """Write a ranking as `ranking.md`, all designs as `ranking.csv`, and the figures.

    drop_heights: m, of the cushion curves.
    """
    shown, ranking = _shown_and_all(summary, question)
    if drop_heights and not has(ranking.table, "driven").any():
        raise RankError(f"{file} has no crush with a place: cushion curves need one; allowed: no "
                        "drop height")  # fmt: skip
    tables = markdown(ranking_sheets(shown, summary))
    explained = "" if shown.table.empty else f"\n{legend(shown)}\n"
    missing = "".join(f"\n{line}\n" for line in incomplete(len(summary), read_attributes(file)))
    text = write_whole(folder / "ranking.md", f"{tables}{explained}{missing}")
    table = write_whole(folder / "ranking.csv", csv_text(ranking.with_unfinished))
    figures = _sweep_figures(file, shown, ranking, drop_heights)
    return [text, table, *(case_plots.save(fig, folder / f"{name}.png") for name, fig in figures)]


def ranking_figures(file: str, summary: DataFrame, question: Question) -> Named:
    """The figures of a ranking, each with its name."""
    yield from _sweep_figures(file, *_shown_and_all(summary, question))


def _shown_and_all(summary: DataFrame, question: Question) -> tuple[Ranking, Ranking]:
    """The requested ranking, and the same ranking of all designs of any mass."""
    shown = answer(summary, question)
    unlimited = question.budget and [inf]  # a budget, so that designs are sorted by J, not J/g
    every = answer(summary, question._replace(budget=unlimited, top=None))
    return shown, replace(every, budgets_g=shown.budgets_g)


def publish_accuracy(file: Path, case_ids: Iterable[str]) -> tuple[list[Sheet], list[Path]]:
    """The sheets of an accuracy study, and the paths of its files beside the results.

    The files: the sheets as Markdown, all columns as CSV, work-precision diagrams. No sheets and no
    files if no case has converged.
    """
    summary = read_summary(file)
    all_studies = studies(file, summary[summary["case_id"].isin(list(case_ids))])
    titled = {scene_title(study, file.stem): study for study in all_studies}
    sheets = [sheet for title, study in titled.items() for sheet in accuracy_sheets(study, title)]
    if not sheets:
        return [], []
    sheets[-1] = sheets[-1]._replace(notes=(MARKS,))
    text = write_whole(file.with_suffix(".md"), markdown(sheets))
    settings = [study.settings.assign(scene=title) for title, study in titled.items()]
    tabulated = csv_text(concat(settings, ignore_index=True))
    table = write_whole(file.with_suffix(".csv"), tabulated)
    figure = case_plots.blank(13.0, 3.6 * len(titled))
    work_precision(figure, titled)
    return sheets, [text, table, case_plots.save(figure, file.with_suffix(".png"))]


def publish_case(file: str, row: Series, folder: Path) -> list[Path]:
    """Draw one case: its force, its energies and six of its shapes, up to its last step."""
    figures = case_figures(file, row)
    return [case_plots.save(figure, folder / f"{name}.png") for name, figure in figures]


def _sweep_figures(
    file: str, shown: Ranking, ranking: Ranking, drop_heights: Sequence[float] = ()
) -> Named:
    """Figures: merit over mass, patterns, trends with wall thickness, energy-absorption diagrams,
    cushion curves, shapes of the winners. Masses of periods of unequal area are not compared.
    """
    for name, figure in _pictures(file, shown, ranking, drop_heights):
        notes = _first_of(name, shown.table, ranking), picture_note(shown)
        case_plots.footnote(figure, "\n".join(filter(None, notes)))
        yield name, figure


def _first_of(name: str, shown: DataFrame, ranking: Ranking) -> str:
    """A line below a picture that draws only the first scenes or winners; else empty."""
    if name == "winners":
        count, most, what = len(_firsts(shown)), MAX_WINNERS, "winners"
    else:
        drawn = [mode for mode, each in MODES.items() if each.picture == name] or ["displacement"]
        rows = ranking.table[ranking.table["loading_mode"].isin(drawn)]
        count, most, what = rows["scene"].nunique(), MAX_SCENES, "rankings"
    return f"The first {most} of {count} {what}." if count > most else ""


def _pictures(file: str, shown: Ranking, ranking: Ranking, drop_heights: Sequence[float]) -> Named:
    pictures = [(mode.picture, name) for name, mode in sorted(MODES.items()) if mode.picture]
    drawn = {picture: _some_scenes(ranking, mode) for picture, mode in pictures}
    for name, part in drawn.items():
        if not (part.table.empty or unequal_periods(part.table)):
            figure = case_plots.blank(*_size(part.table))
            ranking_plots.merit_over_mass(figure, part)
            yield name, figure
    crushed = drawn["absorption"]
    designs = crushed.table
    if len(designs["lattice_kind"].unique()) > 1:
        shapes = _shapes(file, designs)
        figure = case_plots.blank(*panel_size(designs, drawn=bool(shapes)))
        pattern_bars(figure, crushed, shapes)
        yield "patterns", figure
    if ranking_plots.has_trends(designs):
        figure = case_plots.blank(*_size(designs))
        ranking_plots.thickness_trends(figure, crushed)
        yield "wall_thickness", figure
    yield from _cushion_figures(file, designs, ranking.table, drop_heights)
    if winners := _winners(file, shown.table, ranking.table):
        figure = case_plots.blank(12.0, 2.6 * len(winners))
        case_plots.winners(figure, winners)
        yield "winners", figure


def _cushion_figures(
    file: str, crushed: DataFrame, every: DataFrame, drop_heights: Sequence[float]
) -> Named:
    """The energy-absorption diagram of the best crushed designs, and cushion curves (heights: m).

    every: the designs of all loadings, impacts too.
    """
    best = crushed.groupby("scene", sort=False).head(MAX_DRAWN)
    rows = {row["case_id"]: row for _, row in best.iterrows()}
    crushes = {key: crush_of(read_history(file, key), row) for key, row in rows.items()}
    if not any(len(crush.work) for crush in crushes.values()):
        return
    figure = case_plots.blank(*_size(best))
    cushion_plots.absorption_diagram(figure, best, crushes)
    yield "energy_absorption", figure
    falls = drops(every[has(every, "struck")])
    for height in drop_heights:
        figure = case_plots.blank(*_size(best))
        cushion_plots.cushion_diagram(figure, best, crushes, height, falls)
        yield f"cushion_{in_unit(height, 'mm'):g}mm", figure


def _shapes(file: str, designs: DataFrame) -> dict[str, Any]:
    """Frames of all designs by their id; none if there are too many to draw, or if one has none."""
    if len(designs) > MAX_DRAWN:
        return {}
    frames = {row["case_id"]: _frames(file, row) for _, row in designs.iterrows()}
    return frames if all(frames.values()) else {}


def _frames(file: str, row: Series) -> Mapping[str, Any]:
    """The shapes of a case; for an endless panel, of a piece."""
    return piece(read_frames(file, row["case_id"]), row)


def _some_scenes(ranking: Ranking, mode: str) -> Ranking:
    """The designs of one mode, in the first `MAX_SCENES` scenes."""
    designs = ranking.table[ranking.table["loading_mode"] == mode]
    scenes = designs["scene"].unique()[:MAX_SCENES]
    return replace(ranking, table=designs[designs["scene"].isin(scenes)])


def _size(designs: DataFrame) -> tuple[float, float]:
    """Width and height (inches) for one panel per scene, two in a row, and a legend."""
    scenes = len(designs["scene"].unique())
    return 5.0 * min(2, scenes) + 1.8, 4.2 * -(-scenes // 2)


def _firsts(shown: DataFrame) -> DataFrame:
    """The first crushed or struck design of each budget and scene, each once."""
    first = shown[~has(shown, "dead")].drop_duplicates(["budget_g", "scene"])
    return first.drop_duplicates("case_id")


def _winners(file: str, shown: DataFrame, designs: DataFrame) -> dict[str, Mapping[str, Any]]:
    """Frames of the best crushed or struck designs, by a title with budget, scene and design."""
    first, winners = _firsts(shown).head(MAX_WINNERS), {}
    for (_, row), design in zip(first.iterrows(), design_labels(first, designs), strict=True):
        budget = f"up to {budget_text(row['budget_g'])}, " if row["budget_g"] > 0.0 else ""
        if frames := _frames(file, row):
            winners[f"{budget}{row['scene']}: {design}"] = frames
    return winners


def case_figures(file: str, row: Series) -> Named:
    """Figures of the curves and shapes of a case, if it has any."""
    history, frames = read_history(file, row["case_id"]), _frames(file, row)
    mode = MODES[row["loading_mode"]]
    if len(history) > 1:
        charts = {
            "force": (4.4, probe_reactions if mode.probed else case_plots.force_displacement),
            "energies": (4.2, case_plots.energies),
        }
        if history["base_pressure_Pa"].max() > 0.0:
            charts["base_pressure"] = 4.2, base_pressure
        for name, (height, draw) in charts.items():
            figure = case_plots.blank(8.0, height)
            draw(figure.subplots(), history, row)
            yield name, figure
    if frames:
        release = history["time_s"][last_loaded(history, row)] if mode.dead else None
        title = ", ".join(design_and_scene(row))
        yield "shapes", case_plots.shapes_figure(title, frames, release)
        if "quads" in frames:
            inside = cut_open(frames)
            yield "inside", case_plots.shapes_figure(f"{title}, cut open", inside, release)
