"""Rankings and lists of cases as tables of text that fit a terminal of 80 columns."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial

from pandas import DataFrame, Series

from sweep.columns import end_columns
from sweep.loading_modes import compared, mode_of
from sweep.numbers import (
    budget_number,
    budget_text,
    budget_unit,
    error_share,
    in_unit,
    numerals,
    tenths,
)
from sweep.ranking.budget import greatest_mass
from sweep.ranking.ranking import Ranking
from sweep.ranking.scenes import scene_labels
from sweep.report.tables.design_text import design_text, named_case
from sweep.report.tables.marks import densifies_twice, is_unsure, marks
from sweep.report.tables.requirement_notes import (
    FELT,
    panel_column,
    panel_size,
    requirement_columns,
    requirement_notes,
)
from sweep.report.tables.sheet import Sheet
from sweep.report.tables.size_notes import narrow_note, size_note
from sweep.report.tables.unfinished_notes import unfinished_notes

FIRST = {"peak_strain": ": smallest strain first", "peak_force_N": ": least force first"}
NO_PLACE = "No design is ranked here."
LOST = "No design is ranked here: all cases failed ({})."
OPEN = """\
The first place is not certain: in a longer crush (loading.strain) a design with > may lead."""
PASSED_OVER = "{} value alone, {} marked ! or x would stand before the first."
SPARE = {
    "panel mm": "panel_specimens",
    "cycle 2 %": "second_cycle_share",
    "returned %": "returned_share",
    "rebound %": "rebound_share",
    "panel g": "panel_mass_g",
    "left mm": "stroke_left_m",
    "dens. %": "packing_strain",
    "strain %": "peak_strain",
    "peak N": "passed_on_N",
    "mass g": "mass_g",
}
"""Heads of measured columns, and the columns of which they show the values; see `Sheet.spare`."""


def ranking_sheets(ranking: Ranking, summary: DataFrame) -> Iterator[Sheet]:
    """One sheet for each loading scene, with budgets one below another.

    summary: all cases; the keys in which they differ describe the designs. A scene without places
    has no table. If no design is within any budget, a single sheet says so.
    """
    budgets, table = ranking.budgets_g, ranking.table
    named = partial(named_case, among=summary)
    scenes = list(ranking.lightest_g)
    if scenes and ranking.is_above_budgets:
        lightest = _missed(ranking.scenes[0], ranking, named)
        stopped = [note for scene in ranking.scenes for note in _unfinished(scene, ranking, named)]
        yield Sheet("", [], [], notes=(*lightest, *stopped))
        scenes = []
    for scene in scenes:
        placed = rows = table[table["scene"] == scene]
        missed = _missed(scene, ranking, named)
        requirements = tuple(requirement_notes(scene, ranking, named))
        unfinished = _unfinished(scene, ranking, named)
        if rows.empty:
            notes = (*(missed or (NO_PLACE,)), *unfinished, *requirements)
            yield Sheet(scene, [], [], notes=notes)
            continue
        first, unit = {}, budget_unit(budgets)
        if len(budgets) > 1:
            rows = _without_repeats(rows, unit)
            first[f"up to {unit}"] = rows["up_to"].where(~rows["up_to"].duplicated(), "")
        columns = {
            **first,
            "#": _places(rows),
            **design_text(rows, summary),
            **_measures(rows, ranking),
        }
        order = FIRST.get(rows["ranked_by"].iloc[0], "")
        yield Sheet.of(
            f"{scene}{order}",
            columns,
            opens=frozenset(i for texts in first.values() for i, text in enumerate(texts) if text),
            notes=(
                *_passed_over(rows, unit),
                *(_open(placed) if ranking.limited else ()),
                *size_note(placed),
                *narrow_note(ranking.narrow[scene]),
                *_cut_off(rows, unit),
                *_not_shown(placed),
                *unfinished,
                *missed,
                *requirements,
            ),
            spare=_spare(columns, rows, ranking),
            elsewhere="crumple rank with --csv",
            cases=tuple(rows["case_id"]),
        )
    for scene, count in ranking.lost.items():
        notes = (LOST.format(count), *_unfinished(scene, ranking, named))
        yield Sheet(scene, [], [], notes=notes)


def _unfinished(scene: str, ranking: Ranking, named: Callable[[DataFrame], str]) -> tuple[str, ...]:
    """A sentence for each unfinished case of a scene that could have had a place."""
    stopped = ranking.unfinished[ranking.unfinished["scene"] == scene]
    return tuple(unfinished_notes(stopped, named))


def _open(placed: DataFrame) -> Iterator[str]:
    """A note that a crush which ended before the allowed force was reached may lead."""
    if (placed["ends_early"] & (placed["place"] > 1)).any():
        yield OPEN


def _spare(columns: Iterable[str], rows: DataFrame, ranking: Ranking) -> tuple[str, ...]:
    """The heads of measured columns by which these rows are not sorted."""
    sorted_by, energies = set(rows["ranked_by"]), {"J/g": ranking.per_gram}
    shown = SPARE | energies
    return tuple(head for head in shown if head in columns and shown[head] not in sorted_by)


def _missed(scene: str, ranking: Ranking, named: Callable[[DataFrame], str]) -> tuple[str, ...]:
    """A sentence for each budget below the mass of the lightest design of a scene."""
    lightest = ranking.lightest_g.get(scene, 0.0)
    return tuple(
        f"No design weighs {budget_text(budget)} or less; the lightest weighs {lightest:.3g} g, "
        f"{named(ranking.lightest[scene])}."
        for budget in ranking.budgets_g
        if greatest_mass(budget) < lightest
    )


def _places(rows: DataFrame) -> Series:
    """Places with the marks for ties, for the Pareto front, and for doubtful results."""
    places = rows["place"].astype(str) + rows["tied"].map({True: "=", False: ""})
    return places + rows["pareto"].map({True: "*", False: " "}) + marks(rows)


def _passed_over(rows: DataFrame, unit: str) -> Iterator[str]:
    """A sentence for each budget whose first design is exceeded by doubtful ones in value."""
    for _, shown in rows.groupby("budget_g", dropna=False, sort=False):
        count = int(shown["passed_over"].iloc[0])
        within = f"Up to {shown['up_to'].iloc[0]} {unit}, by" if "up_to" in rows else "By"
        if count:
            yield PASSED_OVER.format(within, f"{count} design{'s' * (count > 1)}")


def _cut_off(rows: DataFrame, unit: str) -> Iterator[str]:
    """A sentence for each budget with designs that share the last shown place but are not shown."""
    for _, shown in rows.groupby("budget_g", dropna=False, sort=False):
        last = shown.iloc[-1]
        left = last["sharing"] - (shown["place"] == last["place"]).sum()
        within = f"Up to {last['up_to']} {unit}, " if "up_to" in rows else ""
        if left:
            yield f"{within}{left} more tied for place {last['place']}."


def _not_shown(rows: DataFrame) -> Iterator[str]:
    """A sentence with the number of designs of each budget that have a place but are not shown."""
    groups = rows.groupby("budget_g", dropna=False, sort=False)["contenders"]
    total, shown = groups.max(), groups.size()
    more = [
        f"{total[budget] - count} more"
        + (f" up to {budget_text(budget)}" if len(total) > 1 else "")
        for budget, count in shown.items()
        if count < total[budget]
    ]
    if more:
        yield f"Not shown: {', '.join(more)}; with --top {total.max()}, rank lists all."


def _without_repeats(rows: DataFrame, unit: str) -> DataFrame:
    """Rows of several budgets; budgets with the same places are merged into one section, `up_to`,
    which has masses in a unit.

    A design that is the best up to 20 g and up to 50 g is the best for all budgets in between.
    """
    marked = rows.assign(marked=_places(rows) + rows["case_id"] + rows["sharing"].astype(str))
    same = marked.groupby("budget_g")["marked"].agg(" ".join)
    alike = same.index.to_series().groupby(same)
    low, high = alike.transform("min"), alike.transform("max")
    ends = ({low[b], high[b]} for b in low)
    spans = {min(b): "-".join(budget_number(mass, unit) for mass in sorted(b)) for b in ends}
    kept = rows[rows["budget_g"].isin(low)]
    return kept.assign(up_to=kept["budget_g"].map(spans))


def case_sheet(summary: DataFrame) -> Sheet:
    """All cases with their designs, scenes and statuses."""
    columns = {"case": summary["case_id"], **design_text(summary, summary)}
    columns |= {"scene": scene_labels(summary), "status": summary["status"]}
    return Sheet.of("", columns)


def _measures(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    """Columns of measured values; the sorted column is always among them."""
    columns = {"mass g": numerals(rows["mass_g"])}
    if "counted_mass_g" in rows:
        columns["print g"] = numerals(rows["printed_mass_g"])
    columns |= panel_size(rows)
    if "panel_mass_g" in rows:
        columns["panel g"] = numerals(rows["panel_mass_g"])
    shown = {"printed_mass_g", "counted_mass_g"}
    if least := compared(rows):
        strain = {"strain %": numerals(in_unit(rows["peak_strain"], "%"))}
        columns |= impact_text(rows) if mode_of(rows).struck else strain
        shown |= {least}
    else:
        columns |= _absorbed(rows, ranking)
        shown |= {ranking.energy, ranking.per_gram}
        if not mode_of(rows).probed:
            columns |= {"peak N": numerals(rows["passed_on_N"])} | panel_column(rows)
            columns |= {} if ranking.limited else crush_text(rows)
    columns |= requirement_columns(rows, ranking)
    shown |= {SPARE[head] for head in columns if head in SPARE}
    shown |= {column for head, (_, column) in FELT.items() if head in columns}
    for by in rows["ranked_by"].unique():
        columns |= {} if by in shown else {by: numerals(rows[by])}
        if "ranked_error" in rows:
            share = rows["ranked_error"] / rows[by].abs()
            columns["± %"] = share.map(error_share).where(share.notna(), "?")
    return columns


def impact_text(rows: DataFrame) -> dict[str, Series]:
    """Columns on an impact."""
    return {
        "force N": numerals(rows["peak_force_N"]),
        **panel_column(rows),
        "strain %": numerals(in_unit(rows["peak_strain"], "%")),
        "left mm": numerals(in_unit(rows["stroke_left_m"], "mm")),
        "rebound %": rows["rebound_share"].map(tenths),
    }


def _absorbed(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    energy, noun = rows[ranking.energy], "absorbed" if mode_of(rows).probed else "usable"
    noun = "panel" if "panel_mass_g" in rows else noun
    unit = "mJ" if energy.max() < 1.0 else "J"
    early = rows["ends_early"] & ranking.limited & energy.notna()
    more = early.map({True: "> ", False: ""})
    return {
        f"{noun} {unit}": more + numerals(in_unit(energy, unit)),
        "J/g": more + numerals(rows[ranking.per_gram]),
    }


def crush_text(rows: DataFrame) -> dict[str, Series]:
    """Columns on the whole crush."""
    densified = rows["densification_strain"].notna() | rows["peak_strain"].isna()
    unsure = is_unsure(rows).map({True: "~", False: ""})
    low, high = (rows[name].map(tenths) for name in end_columns("densification_strain"))
    once = rows["packing_strain"].map(tenths) + unsure
    strain = once.where(~densifies_twice(rows), low + "-" + high)
    end = "> " + rows["peak_strain"].map(tenths)
    earlier = rows["lowest_densification_strain"] > 0.0
    end = (low + " or " + end).where(earlier, end)
    second = rows["second_cycle_share"]
    return {
        "dens. %": strain.where(densified, end),
        "returned %": rows["returned_share"].map(tenths),
    } | ({"cycle 2 %": second.map(tenths)} if second.notna().any() else {})
