"""Rankings and lists of cases as tables of text that fit a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from pandas import Series
from pandas.api.types import is_numeric_dtype

from sweep.numbers import NOTHING, SHOWN, numerals, percent, scaled, short, tenths
from sweep.ranking.merit import LEAST, greatest_mass
from sweep.ranking.rank import ASSUMPTIONS, by_scene, scene_label
from sweep.report.tables.requirement_notes import (
    DECELERATION,
    column_notes,
    panel_column,
    panel_note,
    panel_size,
    requirement_columns,
    requirement_notes,
)
from sweep.result import describe_column

if TYPE_CHECKING:
    from pandas import DataFrame

    from sweep.ranking.ranking import Ranking

MARKS = "*: on the Pareto front: no lighter design of the scene is as good. mass: of one specimen."
CRUSHED = "peak: greatest force of one specimen. Peak and energy are counted {until}."
WHOLE = """\
pack: strain at which the lattice has packed down, a mean over strains of nearly the greatest
efficiency; "> 60": not before the end of a crush to 60 %.
back: returned energy / work of the whole crush."""
AGAIN = "again: energy absorbed in the second cycle / in the first; other columns are of the first."
ELASTIC = (
    "Walls are elastic: what does not come back went into friction, damping, snaps or time steps."
)
PLASTIC = "What does not come back is lost in the material, in friction and in snaps."
LOSSY = """\
What does not come back is lost in the material (dissipated_material_J), in friction and in snaps,
or is still stored in walls that relax."""
MIXED = """\
behaviour: of the walls. What does not come back went into friction, damping, snaps or time steps;
where walls are not elastic, also into the material, or it is still stored in walls that relax."""
LOADED = "sink: greatest strain under the load, with its overshoot."
STRUCK = """\
force: greatest force on the support. sink: greatest strain. left: stroke that is left until all
voids are closed. rebound: energy of the striker when it leaves / at first touch."""
FIRST = {"peak_strain": ": least sink first", "peak_force_N": ": least force first"}
TIED = """\
±: estimated error of the sorted column, from mesh and steps, in % of the value; not a bound.
=: a shared place: the errors may reverse the order. Errors that all have in common do not count.
?: the error is unknown; the place is that of the value alone."""
BEYOND = """\
!: do not trust this result, which is beyond the model: an element is shorter than 0.7 of its rest
length, the lattice is pressed below its solid height, a wall is broken (message: where), or walls
that are pressed along the cells fill all of their area (solid_strain)."""
PRINTED = """\
print g: mass as the slicer extrudes it, crossings twice. Budgets, panels and J/g count this mass;
for designs without a slicer they count mass g."""
UNPRINTABLE = """\
p: does not print as drawn (does_not_print: why): walls are no whole number of lines, or gaps are
below a line (lattice.line_width or lattice.nozzle). lattice.printable = true leaves these out."""
NO_PLACE = "No design has a place here."
ID = 4  # letters of an id in a sentence, if no other id begins so
LONG_SPAN = 0.1  # of strain
UNSURE = """\
~: pack is not sharp, as the lattice packs at two strains or slowly: the efficiency is within 2 % of
the greatest over more than 10 % of strain."""
EARLY = """\
>: at least: the crush ended before the allowed force was reached; a longer one absorbs more."""
STRETCHED = """\
^: a wall is stretched beyond the measured curve, which is continued as a straight line (column
stretch_over_curve: how far)."""
CROSSED = "x: walls cross one another, as no contact stops them. Do not trust this result."

WAYS = {"in_plane": "across", "out_of_plane": "along"}
"""How a lattice is pressed, by the column `direction`: across its cells or along them."""

MILLIMETRES = {
    "wall_thickness_m": "wall mm",
    "width_m": "width mm",
    "height_m": "height mm",
    "depth_m": "depth mm",
}
SHOWN_BY_NAME = {
    "lattice.kind",
    "lattice.pattern",
    "lattice.mass",
    "lattice.cells",
    "lattice.cells_x",
    "lattice.cells_y",
    "lattice.wall_thickness",
    "lattice.width",
    "lattice.height",
    "lattice.depth",
    "material.name",
}
"""Grid keys whose values are in a fixed column of the summary."""


SPARE = {
    "panel mm": "panel_specimens",
    "again %": "second_cycle_share",
    "back %": "returned_share",
    "rebound %": "rebound_share",
    "panel g": "panel_mass_g",
    "left mm": "stroke_left_m",
    "pack %": "packing_strain",
    "sink %": "peak_strain",
    "peak N": "passed_on_N",
    "mass g": "mass_g",
}
"""Heads of measured columns, and the columns of which they show the values; see `Sheet.spare`."""


class Sheet(NamedTuple):
    """A table of text. opens: rows that begin a section. notes: lines below the table. spare: heads
    of columns that a narrow terminal may leave out, the first one first; elsewhere: what has them.
    """

    title: str
    heads: list[str]
    rows: list[list[str]]
    opens: frozenset[int] = frozenset()
    notes: tuple[str, ...] = ()
    spare: tuple[str, ...] = ()
    elsewhere: str = ""

    def without(self, head: str) -> Sheet:
        """The table without a column."""
        k = self.heads.index(head)
        heads, *rows = [[*texts[:k], *texts[k + 1 :]] for texts in [self.heads, *self.rows]]
        return self._replace(heads=heads, rows=rows)

    @property
    def columns(self) -> list[list[str]]:
        """The texts below each head."""
        return [[row[i] for row in self.rows] for i in range(len(self.heads))]


def ranking_sheets(ranking: Ranking, summary: DataFrame) -> Iterator[Sheet]:
    """One sheet for each loading scene, with budgets one below another.

    summary: all cases; the keys in which they differ describe the designs. A scene without places
    has no table. If no design is within any budget, a single sheet says so.
    """
    budgets, table = ranking.budgets_g, ranking.table
    named = partial(named_case, among=summary)
    lightest_of_all = min(ranking.lightest_g, key=ranking.lightest_g.__getitem__, default="")
    missed_by_all = _missed(lightest_of_all, ranking, named)
    if missed_by_all and len(missed_by_all) == len(budgets):
        yield Sheet("", [], [], notes=missed_by_all)
        return
    for scene in ranking.lightest_g:
        placed = rows = table[table["scene"] == scene]
        missed = _missed(scene, ranking, named)
        asked = tuple(requirement_notes(scene, ranking, named))
        if rows.empty:
            yield Sheet(scene, [], [], notes=(*(missed or (NO_PLACE,)), *asked))
            continue
        first = {}
        if len(budgets) > 1:
            rows = _without_repeats(rows)
            first["up to g"] = rows["up_to"].where(~rows["up_to"].duplicated(), "")
        columns = {
            **first,
            "#": _places(rows),
            **design_text(rows, summary),
            **_measures(rows, ranking),
        }
        order = FIRST.get(rows["ranked_by"].iloc[0], "")
        yield Sheet(
            title=f"{scene}{order}",
            heads=list(columns),
            rows=[list(row) for row in zip(*columns.values(), strict=True)],
            opens=frozenset(i for i, text in enumerate(first.get("up to g", ())) if text),
            notes=(
                *((BEYOND,) if rows["beyond_model"].any() else ()),
                *((CROSSED,) if rows["crossed"].any() else ()),
                *((PRINTED,) if "print g" in columns else ()),
                *((UNPRINTABLE,) if (_unprintable(rows) != "").any() else ()),
                *((STRETCHED,) if rows["beyond_curve"].any() else ()),
                *((UNSURE,) if "~" in "".join(columns.get("pack %", ())) else ()),
                *((EARLY,) if ranking.limited and rows["ends_early"].any() else ()),
                *_cut_off(rows),
                *_not_shown(placed),
                *missed,
                *asked,
            ),
            spare=_spare(columns, rows, ranking),
            elsewhere="crumple rank with --csv",
        )


def _spare(columns: Iterable[str], rows: DataFrame, ranking: Ranking) -> tuple[str, ...]:
    """The heads of measured columns by which these rows are not sorted."""
    sorted_by, energies = set(rows["ranked_by"]), {"J/g": ranking.per_gram}
    known = SPARE | energies
    return tuple(head for head in known if head in columns and known[head] not in sorted_by)


def _missed(scene: str, ranking: Ranking, named: Callable[[DataFrame], str]) -> tuple[str, ...]:
    """A sentence for each budget below the mass of the lightest design of a scene."""
    lightest = ranking.lightest_g.get(scene, 0.0)
    return tuple(
        f"Nothing weighs {budget:g} g or less: the lightest weighs {lightest:.3g} g, "
        f"{named(ranking.lightest[scene])}."
        for budget in ranking.budgets_g
        if greatest_mass(budget) < lightest
    )


def named_case(row: DataFrame, among: DataFrame) -> str:
    """The beginning of the id and the design of one row, in words."""
    short_of = short_id(row["case_id"].item(), among["case_id"])
    return f"case {short_of}, {design_labels(row, among)[0]}"


def short_id(case_id: str, among: Iterable[str]) -> str:
    """The shortest beginning of an id, of at least `ID` letters, that no other id has."""
    others = [other for other in among if other != case_id]
    lengths = range(ID, len(case_id))
    alone = (n for n in lengths if not any(other.startswith(case_id[:n]) for other in others))
    return case_id[: next(alone, len(case_id))]


def legend(ranking: Ranking) -> str:
    """The meaning of the marks and column heads in the sheets of a ranking."""
    modes = set(ranking.table["loading_mode"])
    heads = {
        "displacement": [CRUSHED.format(until=ranking.until)],
        "force": [LOADED],
        "impact": [STRUCK, _what_is_missing(ranking.table)],
    }
    if not ranking.limited:
        again = [AGAIN] if ranking.table["second_cycle_share"].notna().any() else []
        heads["displacement"] += [WHOLE, *again, _what_is_missing(ranking.table)]
    lines = [line for mode, words in heads.items() if mode in modes for line in words]
    lines += panel_note(ranking.table) + column_notes(ranking)
    bars = [TIED] if "ranked_error" in ranking.table else []
    return "\n".join(dict.fromkeys([MARKS, *lines, *bars]))


def _what_is_missing(rows: DataFrame) -> str:
    """What takes the energy that does not come back: the material, or anything but the material."""
    elastic = rows["material_memory"] == "none"
    if elastic.all():
        return ELASTIC
    if elastic.any():
        return MIXED
    return LOSSY if rows["material_memory"].str.contains("relaxes").any() else PLASTIC


def _places(rows: DataFrame) -> Series:
    """Places with the marks of ties, of the Pareto front, and of doubtful results."""
    places = rows["place"].astype(str)
    if "tied" in rows:
        places += rows["tied"].map({True: "="}).fillna("")
    return places + rows["pareto"].map({True: "*", False: " "}) + marks(rows)


def marks(rows: DataFrame) -> Series:
    """The marks of doubtful results, and of designs that do not print as drawn."""
    beyond = rows["beyond_model"].map({True: "!", False: ""})
    crossed = rows["crossed"].map({True: "x", False: ""})
    beyond_curve = rows["beyond_curve"].map({True: "^", False: ""})
    unprintable = _unprintable(rows).map(lambda why: "p" * bool(why))
    return beyond + crossed + beyond_curve + unprintable


def mark_notes(rows: DataFrame) -> tuple[str, ...]:
    """The meaning of the marks that these rows have."""
    found = {
        BEYOND: rows["beyond_model"],
        CROSSED: rows["crossed"],
        UNPRINTABLE: _unprintable(rows) != "",
        STRETCHED: rows["beyond_curve"],
    }
    return tuple(note for note, has in found.items() if has.any())


def _unprintable(rows: DataFrame) -> Series:
    """What of each design does not print, in words; empty for results of older versions."""
    return rows.get("does_not_print", Series("", rows.index))


def _cut_off(rows: DataFrame) -> Iterator[str]:
    """A sentence for each budget with designs that share the last shown place but are not shown."""
    for _, shown in rows.groupby("budget_g", dropna=False, sort=False):
        last = shown.iloc[-1]
        left = last["sharing"] - (shown["place"] == last["place"]).sum()
        within = f"Up to {last['up_to']} g, " if "up_to" in rows else ""
        if left:
            yield f"{within}{left} more share{'s' if left == 1 else ''} place {last['place']}."


def _not_shown(rows: DataFrame) -> Iterator[str]:
    """A sentence with the number of designs of each budget that have a place but are not shown."""
    groups = rows.groupby("budget_g", dropna=False, sort=False)["contenders"]
    total, shown = groups.max(), groups.size()
    more = [
        f"{total[budget] - count} more" + (f" up to {budget:g} g" if len(total) > 1 else "")
        for budget, count in shown.items()
        if count < total[budget]
    ]
    if more:
        yield f"Not shown: {', '.join(more)}; with --top {total.max()}, rank lists all."


def _without_repeats(rows: DataFrame) -> DataFrame:
    """Rows of several budgets; budgets with the same places are merged into one section, `up_to`.

    A design that is the best up to 20 g and up to 50 g is the best for all budgets in between.
    """
    marked = rows.assign(marked=_places(rows) + rows["case_id"] + rows["sharing"].astype(str))
    same = marked.groupby("budget_g")["marked"].agg(" ".join)
    alike = same.index.to_series().groupby(same)
    low, high = alike.transform("min"), alike.transform("max")
    spans = {b: f"{b:g}" if b == high[b] else f"{b:g}-{high[b]:g}" for b in low}
    kept = rows[rows["budget_g"].isin(low)]
    return kept.assign(up_to=kept["budget_g"].map(spans))


def case_sheet(summary: DataFrame) -> Sheet:
    """All cases with their designs, scenes and statuses."""
    columns = {"case": summary["case_id"], **design_text(summary, summary)}
    scene = Series(index=summary.index, dtype=object)
    for rows in by_scene(summary):
        scene.loc[rows.index] = scene_label(rows)
    columns |= {"scene": scene, "status": summary["status"]}
    return Sheet("", list(columns), [list(row) for row in zip(*columns.values(), strict=True)])


def design_text(frame: DataFrame, among: DataFrame) -> dict[str, Series]:
    """Columns that describe the designs of `frame`, as text in mm and the like.

    Only columns that vary `among` all cases are shown.
    """
    columns = {}
    if _varies(among, "lattice_kind"):
        columns["pattern"] = frame["lattice_kind"].astype(str)
    if "direction" in frame and _varies(among, "direction"):
        columns["pressed"] = frame["direction"].map(WAYS)
    laid = "infill_share" in frame and frame["infill_share"].notna().all()  # cells have no number
    if _varies(among, "cells_x", "cells_y") and not laid:
        columns["cells"] = frame["cells_x"].astype(str) + " x " + frame["cells_y"].astype(str)
    if "infill_share" in frame and _varies(among, "infill_share"):
        share = (100.0 * frame["infill_share"]).map("{:.3g}".format)
        columns["infill %"] = share.where(frame["infill_share"].notna(), "")
    for name, head in MILLIMETRES.items():
        if _sizes_vary(among, name):
            columns[head] = (frame[name] * 1e3).map("{:.3g}".format)
    if _varies(among, "material"):
        columns["material"] = frame["material"].astype(str)
    if _varies(among, "material_memory"):
        columns["behaviour"] = frame["material_memory"].replace("none", "elastic").astype(str)
    by_name = SHOWN_BY_NAME | ({"lattice.infill"} if "infill %" in columns else set())
    for key in frame:
        hidden = key in by_name or key.startswith(ASSUMPTIONS)
        if "." in key and not hidden and _varies(among, key):
            columns |= _grid_text(frame[key], among[key])
    return columns


def _grid_text(values: Series, among: Series) -> dict[str, Series]:
    """The column of a grid key, with its unit; ``among``: its values in all cases."""
    unit = describe_column(str(values.name)).units
    noun = str(values.name).split(".")[-1].replace("_", " ")
    if not unit or not is_numeric_dtype(values):
        return {noun: values.map(short)}
    factor, name = scaled(unit, float(among.abs().max()))
    return {f"{noun} {name}": (factor * values.astype(float)).map(short)}


def about_direction(row: Series) -> list[str]:
    """Sentences about what the model of plates leaves out; none for a case across its cells."""
    if row["direction"] != "out_of_plane":
        return []
    lines = ["pressed along its cells; that printed layers part is not modelled"]
    solid, strain = row["solid_strain"], row["peak_strain"]
    if strain > solid:
        share = f"{100.0 * solid:.3g} %"
        lines.append(
            f"beyond a strain of {share} its walls fill the pressed area: plates are no model"
        )
    return lines


def describe_case(row: Series, among: DataFrame) -> str:
    """The scene and the design of one case of a summary, in words."""
    rows = among.loc[[row.name]]
    return f"{scene_label(rows)}, {design_labels(rows, among)[0]}"


def design_labels(frame: DataFrame, among: DataFrame) -> list[str]:
    """The columns of `design_text` as one text per design: "cells 3 x 3, wall 0.8 mm, cheetah"."""
    columns = design_text(frame, among) or {"material": frame["material"].astype(str)}
    return [
        ", ".join(_with_noun(head, text) for head, text in zip(columns, texts, strict=True) if text)
        for texts in zip(*columns.values(), strict=True)
    ]


def _with_noun(head: str, text: str) -> str:
    """A value with the head of its column: "wall mm", "0.8" -> "wall 0.8 mm"."""
    if head == "infill %":
        return f"{text} % infill"
    noun, _, unit = head.rpartition(" ")
    if noun and unit in SHOWN:
        return f"{noun} {text}" if text == NOTHING else f"{noun} {text} {unit}"
    return text if head in ("material", "pattern") else f"{head} {text}"


def _measures(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    """Columns of measured values; the sorted column is always among them."""
    columns = {"mass g": numerals(rows["mass_g"])}
    if "counted_mass_g" in rows:
        columns["print g"] = numerals(rows["printed_mass_g"])
    columns |= panel_size(rows)
    if "panel_mass_g" in rows:
        columns["panel g"] = numerals(rows["panel_mass_g"])
    shown = {"printed_mass_g", "counted_mass_g"}
    mode = rows["loading_mode"].iloc[0]
    if mode in LEAST:
        columns |= _under_load(rows) if mode == "force" else impact_text(rows)
        shown |= {LEAST[mode]}
    else:
        columns |= _crushed(rows, ranking) | panel_column(rows)
        shown |= {ranking.energy, ranking.per_gram}
        columns |= {} if ranking.limited else crush_text(rows)
    columns |= requirement_columns(rows, ranking)
    shown |= {SPARE[head] for head in columns if head in SPARE}
    shown |= {DECELERATION} if "decel. g0" in columns else set()
    for by in rows["ranked_by"].unique():
        columns |= {} if by in shown else {by: numerals(rows[by])}
        if "ranked_error" in rows:
            share = rows["ranked_error"] / rows[by].abs()
            columns["± %"] = share.map(tenths).where(share.notna(), "?")
    return columns


def _under_load(rows: DataFrame) -> dict[str, Series]:
    return {"sink %": numerals(100.0 * rows["peak_strain"])}


def impact_text(rows: DataFrame) -> dict[str, Series]:
    """Columns about an impact."""
    return {
        "force N": numerals(rows["peak_force_N"]),
        **panel_column(rows),
        "sink %": numerals(100.0 * rows["peak_strain"]),
        "left mm": numerals(1e3 * rows["stroke_left_m"]),
        "rebound %": rows["rebound_share"].map(percent),
    }


def _crushed(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    energy, noun = rows[ranking.energy], "panel" if "panel_mass_g" in rows else "absorbs"
    unit, scale = ("mJ", 1e3) if energy.max() < 1.0 else ("J", 1.0)
    early = rows["ends_early"] & ranking.limited & energy.notna()
    more = early.map({True: "> ", False: ""})
    return {
        f"{noun} {unit}": more + numerals(energy * scale),
        "J/g": more + numerals(rows[ranking.per_gram]),
        "peak N": numerals(rows["passed_on_N"]),
    }


def crush_text(rows: DataFrame) -> dict[str, Series]:
    """Columns about the whole crush."""
    packed = rows["densification_strain"].notna() | rows["peak_strain"].isna()
    unsure = _unsure(rows).map({True: "~", False: ""})
    again = rows["second_cycle_share"]
    return {
        "pack %": (rows["packing_strain"].map(percent) + unsure).where(
            packed, rows["peak_strain"].map(lambda strain: f"> {percent(strain)}")
        ),
        "back %": rows["returned_share"].map(percent),
    } | ({"again %": again.map(percent)} if again.notna().any() else {})


def _unsure(rows: DataFrame) -> Series:
    """True for lattices that have nearly the greatest efficiency over a long span of strain."""
    return rows["packing_span"] > LONG_SPAN


def _sizes_vary(among: DataFrame, name: str) -> bool:
    """Whether a length differs between designs by more than what follows from other columns.

    Along the cells `depth_m` is the plan's over all: its centre lines and a wall, or an outline.
    """
    if name != "depth_m" or "direction" not in among:
        return _varies(among, name)
    along = among["direction"] == "out_of_plane"
    plan = among[along].round(9)
    inner = (plan["depth_m"] - plan["wall_thickness_m"]).round(9)
    return _varies(among[~along], name) or (_varies(plan, name) and len(inner.unique()) > 1)


def _varies(frame: DataFrame, *names: str) -> bool:
    """True if one of the columns has more than one value."""
    return any(len(frame[name].unique()) > 1 for name in names)
