"""The meaning of the marks and the heads of columns in the tables of a ranking."""

from pandas import DataFrame

from sweep.columns import ALONG
from sweep.design.slicer.patterns import is_sheet
from sweep.loading_modes import MODES, Mode, has
from sweep.numbers import tenths
from sweep.ranking.merit import is_period, unequal_periods
from sweep.ranking.ranking import Ranking
from sweep.report.tables.marks import densifies_twice, is_unsure, mark_notes
from sweep.report.tables.requirement_notes import column_notes, of_one, panel_note

ABSORBS = "absorbs as much"
MARKS = "*: on the Pareto front: no lighter design {}. mass: of {}."
CRUSHED = """\
{noun}: energy absorbed {until}; J/g is of it.
peak: greatest force of {of} until then."""
NOT_DENSIFIED = '"> {0}": no densification before the end of the crush, at {0} %.'
RETURNED = "returned: returned energy / work of the whole crush."
PULLED = "Below zero: a glued platen pulls back what stays crushed, by more work than is returned."
SECOND = (
    "cycle 2: energy absorbed in the second cycle / in the first; other columns: the first cycle."
)
ELASTIC = """\
Walls are elastic: the rest is lost to friction, damping, snap-through or time integration."""
PLASTIC = "The rest is lost in the material, to friction and in snap-through."
LOSSY = """\
The rest is lost in the material (dissipated_material_J), to friction and in snap-through, or is
still stored in walls that relax."""
MIXED = """\
behaviour: of the walls. The rest is lost to friction, in the material, in snap-through or in time
integration, or is still stored in walls that relax. In elastic walls, what is lost in the material
is damping."""
SHAPED = """\
striker: it acts on the whole depth as a line; a tooth or a corner narrower than that presses less
of the lattice. Strain is its way after the first touch / height."""
FIRST_LOADING = """\
Results {} are of walls as drawn, at their first loading. Printed ones that
have been pressed before may be several times softer. Mesh and imperfection may change them by a
tenth, so that closer orders are not certain (--error-bars, --spread, lattice.nodes_per_wall)."""
ERRORS = """\
±: estimated error of the sorted column, from mesh and steps, in % of the value; not a bound."""
TIED = "=: a tie: the errors may reverse the order. Errors common to all designs do not count."
UNKNOWN = "?: the error is unknown; the design is placed by its value alone."
PRINTED = """\
print g: mass as the slicer extrudes it{}. Budgets, panels and J/g count this mass;
for designs without a slicer they count mass g."""
UNSURE = """\
~: densification is gradual: the efficiency is within 2 % of the greatest
over more than 10 % of strain."""
TWICE = """\
34-52, 34 or > 60: the efficiency is greatest, within 2 %, at both strains, of which the second may
be the end of the crush; the energy until densification is a range (lowest_..., highest_...)."""
EQUAL = "=: a tie: the values of designs are equal, or their ranges meet."
EARLY = """\
>: at least: the crush ended before the allowed force was reached; a longer one absorbs more."""
ONE_PERIOD = "Sides are tied: mass, force and energy are of one period of a wide panel."
UNEQUAL_PERIODS = """\
Areas differ: compare energy per gram, or panels, not mass, force or energy of one. The Pareto front
compares mass and energy per pressed area."""


def legend(ranking: Ranking) -> str:
    """The meaning of the marks and column heads in the sheets of a ranking."""
    table, of = ranking.table, of_one(ranking.table)
    noun, lines = "panel" if "panel_mass_g" in table else "usable", []
    modes = [MODES[name] for name in sorted(table["loading_mode"].unique())]
    for mode in modes:
        counted = [CRUSHED.format(noun=noun, until=ranking.until, of=of)] if mode.driven else []
        whole = mode.notes and not (mode.driven and ranking.limited)
        lines += [*counted, *(meanings(table, mode) if whole else [])]
    lines += panel_note(table, ranking.panel) + column_notes(ranking) + _notes(ranking)
    return "\n".join(dict.fromkeys([_marks(modes, of), *lines, *_error_notes(table)]))


def _marks(modes: list[Mode], of: str) -> str:
    """The meaning of the star, for all modes of a ranking, and whose mass is shown."""
    fronts = dict.fromkeys(map(front, modes)) or [ABSORBS]
    return MARKS.format(" or ".join(fronts), of)


def front(mode: Mode) -> str:
    """What no lighter design does, if a design is on the Pareto front."""
    return mode.least.front if mode.least else ABSORBS


def _error_notes(table: DataFrame) -> list[str]:
    """The meaning of error bars; none where no error is known."""
    if "ranked_error" not in table:
        return []
    tied = [TIED] * bool(table["tied"].any())
    unknown = [UNKNOWN] * bool(table["ranked_error"].isna().any())
    return [ERRORS, *tied, *unknown]


def _notes(ranking: Ranking) -> list[str]:
    """Explanations that only some tables need: of another mass, and of marks."""
    table = ranking.table
    notes = {
        printed_note(table): "counted_mass_g" in table,
        **dict.fromkeys(mark_notes(table), True),
        **dict.fromkeys(densification_notes(table), not ranking.limited),
        EQUAL: table["tied"].any() and "ranked_error" not in table,
        EARLY: ranking.limited and table["ends_early"].any(),
    }
    return [note for note, is_needed in notes.items() if is_needed]


def densification_notes(rows: DataFrame) -> list[str]:
    """The meaning of strains of densification that are no single number; nothing if all are."""
    crushed = rows[has(rows, "driven")]
    densified, twice = crushed["densification_strain"].notna(), densifies_twice(crushed)
    unsure = is_unsure(crushed) & densified & ~twice
    return [UNSURE] * bool(unsure.any()) + [TWICE] * bool(twice.any())


def meanings(rows: DataFrame, mode: Mode) -> list[str]:
    """The meaning of the columns of a table for one kind of loading, whatever the question."""
    period = [ONE_PERIOD] if is_period(rows).any() else []
    scenes = [part for _, part in rows.groupby("scene")] if "scene" in rows else [rows]
    period += [UNEQUAL_PERIODS] * any(map(unequal_periods, scenes))
    shaped = [] if rows["striker"].isin(("flat", "none")).all() else [SHAPED]
    second = [SECOND] if rows["second_cycle_share"].notna().any() else []
    pulled = [PULLED] if (rows["returned_energy_J"] < 0.0).any() else []
    crushed = [*_not_densified(rows), RETURNED, *pulled, *second] if mode.driven else []
    losses = [_losses(rows)] if mode.driven or mode.struck else []
    return [*mode.notes, *crushed, *losses, *shaped, *_first_loading(rows), *period]


def _first_loading(rows: DataFrame) -> list[str]:
    """A note on walls that are modelled as shells; nothing if there are none."""
    sheet, along = rows["lattice_kind"].map(is_sheet), rows["direction"] == ALONG
    cells = ["along the cells"] if (along & ~sheet).any() else []
    named = " and ".join([*cells, *(["of sheets"] if sheet.any() else [])])
    return [FIRST_LOADING.format(named)] if named else []


def printed_note(rows: DataFrame) -> str:
    """Which mass a slicer extrudes: lines of a sheet do not cross."""
    crossed = ~rows["lattice_kind"].map(is_sheet) & rows["printed_mass_g"].notna()
    return PRINTED.format(", crossings twice" if crossed.any() else "")


def _not_densified(rows: DataFrame) -> list[str]:
    """The text in place of the strain where a crush ends too early; nothing if none does."""
    crushed = rows[has(rows, "driven")]
    ends = crushed["peak_strain"][crushed["densification_strain"].isna()].dropna()
    return [] if ends.empty else [NOT_DENSIFIED.format(tenths(ends.iloc[0]))]


def _losses(rows: DataFrame) -> str:
    """Where the energy that is not returned goes: into the material, or anywhere else."""
    elastic = rows["material_memory"] == "none"
    if elastic.all():
        return ELASTIC
    if elastic.any():
        return MIXED
    return LOSSY if rows["material_memory"].str.contains("relaxes").any() else PLASTIC
