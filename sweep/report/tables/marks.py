"""The marks of doubtful results in the tables of a ranking, and what each mark means."""

from functools import reduce
from math import inf, isnan
from operator import add

from pandas import DataFrame, Series

from sweep.columns import end_columns, is_grid_key
from sweep.loading_modes import MODES, Coarse, exceeds, has
from sweep.numbers import in_unit, tenths, to_si
from sweep.ranking.unfinished import unloaded

LITTLE_PASSED = 1.0 / 3.0  # of the greatest unfiltered deceleration
LITTLE_STROKE = 0.1  # of the stroke that closes all voids
LONG_SPAN = 0.1  # span of strain
COARSE = """\
i: {} are long: their estimated error is above {} % of {}, here up to {} %
({}). {} Shorter steps help ({})."""
NO_PEAK = """\
i: {} are too long for {}. {}
Shorter steps help ({})."""
MEANINGS = {
    "!": """\
!: do not trust this result, which is beyond the model: an element in the plane is shorter than 0.7
of its rest length, the lattice is pressed below its solid height, a wall is broken (message: where)
or walls that are shells fill the whole area (solid_strain). Placed behind all others.""",
    "x": """\
x: walls cross one another, as no contact stops them. Do not trust this result; it is placed behind
all others.""",
    "p": """\
p: does not print as drawn (does_not_print: why): walls are not a multiple of the line width, or
gaps narrower (lattice.line_width or lattice.nozzle). lattice.printable = true excludes these.""",
    "f": """\
f: the filter takes most of the pulse: the greatest filtered force on the striker is below the mean
one, or less than a third of the unfiltered one. A greater loading.filter_class helps.""",
    "s": """\
s: less than a tenth of the stroke is left, where the force rises steeply: it may err by a third
(more lattice.nodes_per_wall, or --error-bars, tell).""",
    "^": """\
^: a wall is stretched beyond the measured curve, which is continued as a straight line (column
stretch_over_curve: how far).""",
    "u": """\
u: stopped after its loading (message: why), which determines energy, peak and densification; what
only unloading tells is not known (–).""",
    "r": """\
r: simulated with another value of a key that varies, as it failed with this one (retry: which).""",
    "b": """\
b: simulated with another imperfection, as it stopped with the one asked for (retry: which).""",
}


def marks(rows: DataFrame) -> Series:
    """The marks of each row, such as "!x"; "" of a result without doubt that prints as drawn."""
    marked = _marked(rows).items()
    return reduce(add, (flags.map({True: mark, False: ""}) for mark, flags in marked))


def mark_notes(rows: DataFrame) -> tuple[str, ...]:
    """The meaning of the marks that these rows have."""
    marked = _marked(rows)
    meanings = [meaning for mark, meaning in MEANINGS.items() if marked[mark].any()]
    long = rows[marked["i"]]
    steps = [
        _coarse_note(measure, rows_of[exceeds(rows_of, measure)])
        for name, rows_of in long.groupby("loading_mode", sort=False)
        for measure in MODES[str(name)].coarse
    ]
    return (*filter(None, steps), *meanings)


def _coarse_note(coarse: Coarse, rows: DataFrame) -> str:
    """The meaning of "i" in rows that exceed one measure; empty without such rows."""
    if rows.empty:
        return ""
    if isnan(coarse.most):
        return NO_PEAK.format(coarse.steps, coarse.whole, coarse.effect, coarse.keys)
    most = f"{in_unit(coarse.most, '%'):g}"
    greatest = tenths(float(rows[coarse.column].replace(inf, 1.0).max()))
    about = (coarse.steps, most, coarse.whole, greatest, coarse.column, coarse.effect, coarse.keys)
    return COARSE.format(*about)


def _marked(rows: DataFrame) -> dict[str, Series]:
    """The rows that have each mark, in the order in which a row shows its marks."""
    return {
        "!": rows["beyond_model"],
        "x": rows["crossed"],
        "i": rows["coarse"],
        "f": cut_by_filter(rows),
        "s": uses_up_stroke(rows) & ~rows["beyond_model"],
        "^": rows["beyond_curve"],
        "p": rows["does_not_print"] != "",
        "u": unloaded(rows),
        "r": retried(rows),
        "b": rows["retry"].str.contains("imperfection"),
    }


def cut_by_filter(rows: DataFrame) -> Series:
    """True for impacts whose greatest filtered deceleration could not do the work on the lattice
    over its greatest stroke, or is less than `LITTLE_PASSED` of the unfiltered one.
    """
    passed = rows["peak_deceleration_filtered_m_per_s2"]
    force = to_si(rows["striker_mass_g"], "g") * passed
    is_cut = rows["absorbed_energy_J"] > force * rows["indentation_m"]
    little = passed < LITTLE_PASSED * rows["peak_deceleration_m_per_s2"]
    return has(rows, "struck") & (is_cut | little)


def uses_up_stroke(rows: DataFrame) -> Series:
    """True for impacts that leave little of the stroke that closes all voids."""
    left = rows["stroke_left_m"]
    whole = left + rows["peak_strain"] * rows["height_m"]
    return has(rows, "struck") & (left < LITTLE_STROKE * whole)


def retried(rows: DataFrame) -> Series:
    """True for results whose retry has another value of a key that varies in the sweep."""
    keys = [str(name) for name in rows if is_grid_key(str(name))]
    return rows["retry"].map(lambda retry: any(f"{key} = " in retry for key in keys)).astype(bool)


def is_unsure(rows: DataFrame) -> Series:
    """True for lattices that have nearly the greatest efficiency over a long span of strain."""
    return rows["packing_span"] > LONG_SPAN


def densifies_twice(rows: DataFrame) -> Series:
    """True for lattices with nearly the greatest efficiency at two strains, in whole percent."""
    low, high = (rows[name].map(tenths) for name in end_columns("densification_strain"))
    return low != high
