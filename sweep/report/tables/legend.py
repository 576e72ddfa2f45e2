"""The marks in tables of a ranking, and what marks and heads of columns mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pandas import Series

from sweep.numbers import percent
from sweep.report.tables.requirement_notes import (
    column_notes,
    panel_note,
)

if TYPE_CHECKING:
    from pandas import DataFrame

    from sweep.ranking.ranking import Ranking

MARKS = "*: on the Pareto front: no lighter design of the scene is as good. mass: of one specimen."
CRUSHED = "peak: greatest force of one specimen. Peak and energy are counted {until}."
PACKED = (
    "pack: strain at which the lattice has packed down: energy / greatest force is greatest there."
)
NOT_PACKED = '"> {0}": it has not packed at the end of the crush, at {0} %.'
BACK = "back: returned energy / work of the whole crush."
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
UNSURE = """\
~: pack is not sharp, as the lattice packs at two strains or slowly: the efficiency is within 2 % of
the greatest over more than 10 % of strain."""
EARLY = """\
>: at least: the crush ended before the allowed force was reached; a longer one absorbs more."""
STRETCHED = """\
^: a wall is stretched beyond the measured curve, which is continued as a straight line (column
stretch_over_curve: how far)."""
HEADS = ("displacement", "force", "impact")
CROSSED = "x: walls cross one another, as no contact stops them. Do not trust this result."


def legend(ranking: Ranking) -> str:
    """The meaning of the marks and column heads in the sheets of a ranking."""
    table = ranking.table
    heads = {mode: meanings(table, mode) for mode in dict.fromkeys(table["loading_mode"])}
    if "displacement" in heads:
        whole = [] if ranking.limited else heads["displacement"]
        heads["displacement"] = [CRUSHED.format(until=ranking.until), *whole]
    lines = [line for mode in HEADS if mode in heads for line in heads[mode]]
    lines += panel_note(table) + column_notes(ranking)
    bars = [TIED] if "ranked_error" in table else []
    return "\n".join(dict.fromkeys([MARKS, *lines, *bars]))


def meanings(rows: DataFrame, mode: str) -> list[str]:
    """What the columns mean that a table has for one kind of loading, whatever is asked."""
    if mode == "displacement":
        again = [AGAIN] if rows["second_cycle_share"].notna().any() else []
        return [PACKED, *_not_packed(rows), BACK, *again, _what_is_missing(rows)]
    if mode == "impact":
        return [STRUCK, _what_is_missing(rows)]
    return [LOADED] if mode == "force" else []


def _not_packed(rows: DataFrame) -> list[str]:
    """What stands in place of the strain where a crush ends too early; nothing if none does."""
    crushed = rows[rows["loading_mode"] == "displacement"]
    ends = crushed["peak_strain"][crushed["densification_strain"].isna()].dropna()
    return [] if ends.empty else [NOT_PACKED.format(percent(ends.iloc[0]))]


def _what_is_missing(rows: DataFrame) -> str:
    """What takes the energy that does not come back: the material, or anything but the material."""
    elastic = rows["material_memory"] == "none"
    if elastic.all():
        return ELASTIC
    if elastic.any():
        return MIXED
    return LOSSY if rows["material_memory"].str.contains("relaxes").any() else PLASTIC


def marks(rows: DataFrame) -> Series:
    """The marks of doubtful results, and of designs that do not print as drawn."""
    beyond = rows["beyond_model"].map({True: "!", False: ""})
    crossed = rows["crossed"].map({True: "x", False: ""})
    beyond_curve = rows["beyond_curve"].map({True: "^", False: ""})
    undrawn = unprintable(rows).map(lambda why: "p" * bool(why))
    return beyond + crossed + beyond_curve + undrawn


def mark_notes(rows: DataFrame) -> tuple[str, ...]:
    """The meaning of the marks that these rows have."""
    found = {
        BEYOND: rows["beyond_model"],
        CROSSED: rows["crossed"],
        UNPRINTABLE: unprintable(rows) != "",
        STRETCHED: rows["beyond_curve"],
    }
    return tuple(note for note, has in found.items() if has.any())


def unprintable(rows: DataFrame) -> Series:
    """What of each design does not print, in words."""
    return rows["does_not_print"]
