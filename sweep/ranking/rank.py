"""Which design absorbs the most energy: per gram, within a weight budget, below an allowed force.

Only cases of the same loading scene are compared, since the energies absorbed under a dead load and
in a crush to half the height answer different questions. Under a dead load the design with the
smallest strain is the best, under a striker the one with the least force on the support. Designs
whose results cannot be trusted (`merit.doubtful`) come last, whatever their values.
"""

from collections.abc import Iterable, Mapping, Sequence
from os import PathLike

import numpy as np
import pandas as pd
from pandas import DataFrame

from sweep.columns import (
    COLUMNS,
    describe_column,
    error_column,
    is_grid_key,
    less_is_better,
    nearest_names,
)
from sweep.loading_modes import compared
from sweep.numbers import in_unit
from sweep.ranking.budget import within_budget
from sweep.ranking.curves import with_allowed
from sweep.ranking.merit import (
    Compared,
    check_areas,
    check_budgets,
    doubtful,
    is_period,
    merits,
    pressed_area,
)
from sweep.ranking.narrow import narrow_patterns
from sweep.ranking.pareto import pareto
from sweep.ranking.places import passed_over, places_by
from sweep.ranking.question import Quantity, Question, RankError, check_units, in_si
from sweep.ranking.ranking import Ranking
from sweep.ranking.requirements import check, judge, limits
from sweep.ranking.scenes import by_scene, scene_labels
from sweep.ranking.unfinished import (
    FIRST,
    could_place,
    ended_early,
    interrupted,
    loaded,
    unloaded,
)

PER = ("specimen", "panel")
USUAL = (
    *("absorbed_energy_until_packed_J", "specific_absorption_until_packed_J_per_g"),
    *("absorbed_energy_J", "specific_absorption_J_per_g", "absorbed_energy_within_model_J"),
    *("lost_energy_J_per_g", "second_cycle_share", "mass_g", "peak_force_N"),
    *("peak_force_until_packed_N", "peak_strain", "peak_deceleration_filtered_m_per_s2"),
)
"""The columns by which rankings are sorted most: a refusal names these instead of all."""
LEADING = [
    "budget_g",
    "scene",
    "place",
    "tied",
    "pareto",
    "case_id",
    "ranked_by",
    "ranked_error",
    "sharing",
    "contenders",
    "passed_over",
    "counted_mass_g",
    "panel_specimens",
    "panel_width_m",
    "panel_depth_m",
    "panel_mass_g",
    "panel_energy_J",
    "panel_force_N",
    "passed_on_N",
    "returned_share",
    "ends_early",
    "beyond_model",
    "crossed",
    "coarse",
    "beyond_curve",
]


def rank(  # noqa: PLR0913  every argument is a part of one question
    source: str | PathLike[str] | DataFrame,
    budget: Quantity | Sequence[Quantity] | None = None,
    panel: Sequence[Quantity] | None = None,
    by: str | None = None,
    top: int | None = 10,
    allowed_force: Quantity | None = None,
    require: Mapping[str, Quantity | None] | None = None,
    per: str = "specimen",
) -> DataFrame:
    """Best designs of each loading scene, best first.

    Parameters
    ----------
    source : results file, or a summary from `read_summary`.
    budget : greatest mass of the panel, or of the specimen without panel: text with a unit, such as
        "25 g". Several budgets give one ranking each, distinguished by the column `budget_g`.
    panel : two lengths, such as ("100 mm", "50 mm"), which specimens fill side by side and one
        behind the other; `sweep.design.panel` has the rule.
    by : column to sort by, the better values first (`Column.better`); a column without better
        values is refused. Default: under a dead load the smallest strain, under a striker the least
        force on the support (`Mode.least`). Otherwise the greatest energy absorbed until
        densification if a budget or a panel is given, else the greatest energy per gram. With
        `absorbed_energy_J` or `specific_absorption_J_per_g`, energy is counted to full stroke, with
        `absorbed_energy_at_densification_J` or the same per gram to the greatest efficiency.
    top : number of designs listed for each scene and budget; None lists all.
    allowed_force : count energy only up to this force, such as "50 N". A table as the source needs
        the column `absorbed_energy_at_..N_J`, and knows no force of a panel; a file has the curves.
    require : limits that a design must meet to be ranked: `max_force`, `max_deceleration`
        (filtered), `max_mass`, `min_absorbed`, `max_stroke`.
    per : "specimen" or "panel": to which `allowed_force` and `require` apply.

    A bare number is refused; `ranked` takes numbers too, in SI.

    Returns
    -------
    The rows of the summary that have a place. The first columns are:

    budget_g, scene : the ranking to which a row belongs.
    place : equal values share a place, and so do values whose order the estimated errors may
        reverse (`shared_places`). Designs that are `beyond_model` or `crossed` come after all
        others.
    tied : True if the place is shared.
    ranked_error : with error bars: the error of the value.
    sharing, contenders : number of designs with this place, and with any place, including those
        that `top` cuts off.
    passed_over : number of designs that have a better value but come later, as they are doubtful.
    pareto : True if no design of the scene is lighter and absorbs as much, and none absorbs more
        and is as light, among trusted designs that meet all requirements; where `Mode.least`
        is compared, the same with that column.
    ranked_by : the sorting column.
    counted_mass_g : where designs have a slicer: mass as extruded, for others mass of the walls.
    panel_specimens, panel_width_m, panel_depth_m : number of specimens of a panel, in
        parts if they are periods, and the true lengths of that panel.
    panel_mass_g, panel_energy_J, panel_force_N : of these specimens together.
    passed_on_N, counted_stroke_m : greatest force while the usable energy is absorbed, and the
        stroke that this takes.
    returned_share : returned energy / work of the whole crush.
    ends_early : True if a crush ended before the allowed force was exceeded or before the lattice
        densified: in a longer one it absorbs more than the usable energy.
    beyond_model : True if an element is too short or a wall breaks while the usable energy is
        absorbed, or if the lattice is compressed to less than its solid height.
    crossed : True if walls crossed one another.
    coarse : True if load or time steps are too long (`sweep.loading_modes.Coarse`).
    beyond_curve : True if a wall was stretched beyond the measured curve in the run.
    """
    quantities = {"budget": budget, "panel": panel, "allowed_force": allowed_force}
    check_units(quantities | dict(require or {}))
    question = Question(budget, panel, by, top, allowed_force, require, per)
    return answer(source, question).table


def ranked(  # noqa: PLR0913  every argument is a part of one question
    source: str | PathLike[str] | DataFrame,
    budget: Quantity | Sequence[Quantity] | None = None,
    panel: Sequence[Quantity] | None = None,
    by: str | None = None,
    top: int | None = 10,
    allowed_force: Quantity | None = None,
    require: Mapping[str, Quantity | None] | None = None,
    per: str = "specimen",
) -> Ranking:
    """The `Ranking` whose table `rank` returns for the same arguments; numbers are in SI."""
    return answer(source, Question(budget, panel, by, top, allowed_force, require, per))


def answer(source: str | PathLike[str] | DataFrame, question: Question) -> Ranking:
    """The ranking of a results file, or of a summary."""
    _, panel, by, top, allowed_force, require, per = question
    if per not in PER:
        raise RankError(f'per = "{per}"; allowed: {" or ".join(PER)}')
    required, summary = limits(require), source
    if not isinstance(summary, DataFrame):
        from sweep.store.read import read_summary  # nothing else here needs the store

        summary = with_allowed(summary, read_summary(summary), question)
    if missing := next((name for name in COLUMNS if name not in summary), None):
        raise RankError(f"no {missing}; needed: all columns of a summary (`read_summary`)")
    whole, names = merits(summary, question)
    finished = loaded(whole)
    check(finished, required)
    check_budgets(finished, question)
    usual = names.energy if question.budgets or panel is not None else names.per_gram
    by = by and _column(whole[:0], by)
    masses = [*dict.fromkeys(in_unit(in_si(mass, "kg"), "g") for mass in question.budgets)] or [
        np.inf
    ]
    labels = scene_labels(whole)
    scene_rows = by_scene(finished, labels)
    for rows in scene_rows.values():
        check_areas(rows, question, required)
    allowed = np.nan if allowed_force is None else in_si(allowed_force, "N")
    judged = {
        label: judge(rows, names, required, per, masses, allowed)
        for label, rows in scene_rows.items()
    }
    ranked = {
        label: (_with_scene(rows[judged[label][0]], label, names), by or compared(rows) or usual)
        for label, rows in scene_rows.items()
    }
    scenes = list(ranked.values())
    placed = [
        part for rows, order in scenes for part in _places(rows, names.mass, order, masses, top)
    ]
    stopped = []
    for label, cases in by_scene(whole[interrupted(whole) | unloaded(whole)], labels).items():
        rows, order = ranked.get(label, (whole[:0], by or compared(cases) or usual))
        parts = could_place(rows, cases, order, masses, names, question, required)
        alone = {} if label in ranked else {"least_place": np.nan}  # beside no ranked design
        stopped += [part.assign(scene=label, **alone) for part in parts]
    return Ranking(
        table=_arranged(placed, LEADING, summary),
        unfinished=_arranged(stopped, FIRST, summary),
        **names._asdict(),
        limited=allowed_force is not None,
        by=next((o for rows, o in scenes if by or not compared(rows)), scenes[0][1]),
        cases=len(summary),
        failed=len(summary) - len(finished),
        unloaded=int(unloaded(finished).sum()),
        unranked=sum(
            int((rows[order].isna() & ~ended_early(rows, order)).sum()) for rows, order in scenes
        ),
        without_bar=sum(_without_bar(rows, order) for rows, order in scenes),
        pointed=int((finished["solid_joint_share"] < 1.0).sum()),
        versions=model_versions(finished),
        budgets_g=tuple(limit for limit in masses if np.isfinite(limit)),
        lightest={
            label: rows.sort_values([names.mass, "case_id"])[:1]
            for label, rows in scene_rows.items()
            if len(rows)
        },
        narrow={label: narrow_patterns(rows) for label, rows in scene_rows.items()},
        lost=labels[~labels.isin(list(scene_rows))].value_counts(sort=False).to_dict(),
        panel=tuple(in_si(side, "m") for side in panel or ()),
        per=per,
        required=required,
        outcomes={label: outcomes for label, (_, outcomes) in judged.items() if required},
    )


def _arranged(parts: Sequence[DataFrame], first: Iterable[str], summary: DataFrame) -> DataFrame:
    """All rows: some columns first, then the columns of the summary, then the added ones."""
    rows = pd.concat(parts, ignore_index=True)
    leading = [name for name in first if name in parts[0]]
    return rows[[*dict.fromkeys([*leading, *summary, *rows])]]


def model_versions(summary: DataFrame) -> dict[int, int]:
    """Number of rows of each version of the model, the oldest first."""
    counts = summary["model_version"].value_counts().sort_index()
    return {int(version): int(number) for version, number in counts.items()}


def _with_scene(rows: DataFrame, label: str, names: Compared) -> DataFrame:
    """Rows of one scene with its label and their Pareto flag; the front consists of trusted
    designs.

    Where some are periods of a wide panel, whose sizes have no meaning, mass and energy per area
    are compared.
    """
    sound, least = rows[~doubtful(rows)], compared(rows)
    mass, merit = sound[names.mass], sound[names.energy] if least is None else -sound[least]
    if least is None and names.mass != "panel_mass_g" and is_period(sound).any():
        area = pressed_area(sound)
        mass, merit = (values / area * area.mean() for values in (mass, merit))
    front = sound.index[pareto(mass, merit)]
    return rows.assign(scene=label, pareto=rows.index.isin(front))


def _places(
    rows: DataFrame, mass: str, by: str, budgets_g: Iterable[float], top: int | None
) -> list[DataFrame]:
    """The first ``top`` rows of one scene within each budget, best first, doubtful ones last.

    Rows of equal value are sorted by mass, then by id, so that the order of the input rows does not
    matter.
    """
    order = [*dict.fromkeys(["doubtful", by, mass, "case_id"])]
    upwards = [name != by or less_is_better(by) for name in order]
    rows = rows.dropna(subset=by)
    rows = rows.assign(doubtful=doubtful(rows)).sort_values(order, ascending=upwards)
    rows = rows.drop(columns="doubtful")
    return [_within(rows[within_budget(rows[mass], g)], by, g, top) for g in budgets_g]


def _within(rows: DataFrame, by: str, budget_g: float, top: int | None) -> DataFrame:
    """The first of the sorted rows within a budget, with their places."""
    error = rows.get(error_column(by))
    place = places_by(rows, by)
    columns = {"tied": place.duplicated(keep=False)}
    if error is not None:
        columns["ranked_error"] = error
    limit = budget_g if np.isfinite(budget_g) else np.nan
    sharing = place.map(place.value_counts()).astype(int)  # where nothing is, too
    columns |= {"sharing": sharing, "contenders": len(rows), "passed_over": passed_over(rows, by)}
    rows = rows.assign(budget_g=limit, place=place, ranked_by=by, **columns)
    return rows.head(len(rows) if top is None else top)


def _without_bar(rows: DataFrame, by: str) -> int:
    """Number of rows with a value to sort by but without its error bar; 0 without error bars."""
    bar = error_column(by)
    return int((rows[by].notna() & rows[bar].isna()).sum()) if bar in rows else 0


def _column(frame: DataFrame, by: str) -> str:
    """The column to sort by; refused if it is unknown or has no better values."""
    numbers = [name for name in frame.select_dtypes("number") if not is_grid_key(name)]
    allowed = [name for name in numbers if describe_column(name).better]
    if by in allowed:
        return by
    is_column = by in numbers
    why = "neither more nor less of it makes a design better" if is_column else "no such column"
    usual = ", ".join(name for name in USUAL if name in allowed)
    more = len(allowed) - sum(name in allowed for name in USUAL)
    raise RankError(
        f'cannot sort by "{by}": {why}{nearest_names(by, allowed)}\nallowed: {usual} and '
        f"{more} others: the first line of rank --csv has all, docs/results.md explains most"
    )
