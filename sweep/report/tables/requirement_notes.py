"""Sentences on the requirements, and on how many designs fail each of them."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from textwrap import fill

from pandas import DataFrame, Series

from sweep.loading_modes import MODES, applies_to, has, mode_of
from sweep.numbers import (
    SMALLEST_SHOWN,
    budget_text,
    energy_text,
    in_unit,
    numerals,
    percent,
    tenths,
    three_digits,
)
from sweep.ranking.merit import doubtful, is_period
from sweep.ranking.ranking import Ranking
from sweep.ranking.requirement_table import MEASURES
from sweep.ranking.requirements import Outcome

ONE_SPECIMEN = "panel N: force of the panel, which is one specimen of {} mm."
ONE_BY_ONE = (
    "Specimens are simulated one by one: neighbours that widen by more than the gap\n"
    "of 0.4 mm press on one another."
)
PANEL = (
    "panel N: force of the {} separate specimens of a panel together. Its true size is {} mm.\n"
    + ONE_BY_ONE
)
UNEQUAL = (
    "Their number differs, so that places depend on it: compare J/g, or choose sides that all fill."
)
TOLERATED = 0.05  # relative difference of a side
OTHER_SIZE = (
    "Whole specimens make a panel whose sides differ by up to {} % from the {} mm of the question."
    "\n"
    "Mass, energy and force are of the panel that they make."
)
WHOLE_PANEL = "panel N: force of a panel in one piece of {} mm; effects of its edges are neglected."
STRUCK_PANEL = "All specimens of a panel are struck at once, each by its own striker."
COLUMN_NOTES = {
    "decel. g0": "decel.: greatest deceleration of the striker, filtered (loading.filter_class).",
    "base kPa": "base: greatest pressure on a patch of the base (loading.base_patch), unfiltered.",
    "target g0": "target: greatest acceleration of the base, which moves freely.",
    "stroke mm": "stroke: over which the energy counts; without a crush, the greatest.",
}
FELT = {
    "decel. g0": ("max_deceleration", "peak_deceleration_filtered_m_per_s2"),
    "base kPa": ("max_base_pressure", "peak_base_pressure_Pa"),
    "target g0": ("max_target_acceleration", "peak_target_acceleration_m_per_s2"),
}
"""Columns on what striker and base feel, each with its requirement and its column of results."""
WIDTH = 100  # most letters in a line
LESS = "less than "
DISTRUST = "marked {}: do not trust it"


def quantity(name: str, value: float) -> str:
    """The value of a requirement (SI) in its unit."""
    if name == "min_absorbed":
        return energy_text(value)
    shown = MEASURES[name].shown
    return f"{float(f'{in_unit(value, shown):.4g}'):g} {shown}"


def required(ranking: Ranking, modes: Iterable[str]) -> str:
    """The requirements for these kinds of loading in one sentence; empty if there are none."""
    kinds = set(modes)
    own = {k: v for k, v in ranking.required.items() if kinds.intersection(applies_to(k))}
    limits = [MEASURES[k].limit.format(quantity(k, v)) for k, v in own.items()]
    return f"Required of {of_which(ranking)}: {', '.join(limits)}." if limits else ""


def of_one(rows: DataFrame) -> str:
    """To what masses and forces refer: the printed part, a specimen of a tiled panel, or a
    period.
    """
    periods = is_period(rows)
    if len(rows) and periods.all():
        return "one period"
    one = "one specimen" if "panel_specimens" in rows else "the part"
    return f"{one} or one period" if periods.any() else one


def of_which(ranking: Ranking) -> str:
    """To what an allowed force and requirements refer."""
    if ranking.per == "panel":
        return "a panel"
    one = of_one(ranking.designs)
    return "a specimen" if one == "one specimen" else one


def titled(title: str, ranking: Ranking) -> str:
    """The title of a picture with the requirements on a line of their own."""
    return "\n".join(filter(None, [title, required(ranking, ranking.table["loading_mode"])]))


def requirement_notes(
    scene: str, ranking: Ranking, named: Callable[[DataFrame], str]
) -> Iterator[str]:
    """Sentences about the requirements in one scene: their limits, the designs that fail, the
    nearest design.

    named: the id and the design of a row, in words.
    """
    outcomes = ranking.outcomes.get(scene, ())
    if not outcomes:
        return
    first = outcomes[0]
    if sentence := required(ranking, [first.mode]):
        yield fill(sentence, WIDTH)
        yield from _of_budgets(outcomes, ranking, named)
    alike = [label for label, others in ranking.outcomes.items() if others[0].mode == first.mode]
    if first.left_out and scene == alike[0]:
        yield f"Not applied to {MODES[first.mode].without}: {', '.join(first.left_out)}."


def _of_budgets(
    outcomes: Sequence[Outcome], ranking: Ranking, named: Callable[[DataFrame], str]
) -> Iterator[str]:
    """The counts of each budget with a design, then the statements that most of them share."""
    counted = [outcome for outcome in outcomes if outcome.designs]
    for outcome in counted:
        yield _counts(outcome)
    widest = max(counted, key=lambda outcome: outcome.designs, default=outcomes[0])
    for name, count in widest.unknown.items():
        if count:
            yield f"{count} without a value for {name}: {MEASURES[name].unknown}."
    for name, rows in widest.close.items():
        if len(rows):
            yield fill(_close(name, rows, named), WIDTH)
    if widest.open:
        which = f"{widest.open} of those that fail may fulfil min_absorbed in a longer crush"
        end = "the allowed force was reached" if ranking.limited else "densification"
        yield f"{which}: theirs ended before {end}."
    for _, alike in groupby(counted, lambda outcome: list(outcome.nearest["case_id"])):
        yield from _nearest(list(alike), ranking.required, named)
    if any(outcome.fulfil > outcome.doubtful for outcome in counted):
        return
    if not (row := widest.lightest).empty:
        mass = f"{row[ranking.mass].item():.3g} g"
        yield f"The lightest design that fulfils this weighs {mass}: {named(row)}."
    elif counted:
        yield from _rectangle(widest)


def _within(*outcomes: Outcome) -> str:
    budgets = [outcome.budget_g for outcome in outcomes]
    return "" if math.isnan(budgets[0]) else f" up to {', '.join(map(budget_text, budgets))}"


def _counts(outcome: Outcome) -> str:
    """How many designs within the budget fulfil all requirements, how many of these are doubtful,
    and how many fail each.
    """
    failing = outcome.designs - outcome.fulfil
    marked = f", {outcome.doubtful} of them marked ! or x" if outcome.doubtful else ""
    if not failing:
        every = f"All designs{_within(outcome)} ({outcome.designs}) fulfil this{marked}."
        return every + _uncertain(outcome)
    parts = [f"{name} ({count})" for name, count in outcome.failed.items() if count]
    several = "; some fail several" if sum(outcome.failed.values()) > failing else ""
    fulfil = f"{outcome.fulfil} of {outcome.designs} designs{_within(outcome)} fulfil this{marked}"
    return f"{fulfil}; {failing} fail: {', '.join(parts)}{several}.{_uncertain(outcome)}"


def _uncertain(outcome: Outcome) -> str:
    """How many designs fulfil all requirements by values that long steps make uncertain."""
    count = outcome.coarse
    if not count:
        return ""
    some = f"{count} of those that do {'is' if count == 1 else 'are'}"
    which = some if count < outcome.fulfil else "It is" if count == 1 else "All of these are"
    return f"\n{which} marked i: with shorter steps {'it' if count == 1 else 'they'} may fail."


def _close(name: str, rows: DataFrame, named: Callable[[DataFrame], str]) -> str:
    """The designs that meet or miss a requirement by less than the uncertainty of their value."""
    first, count = rows[:1], len(rows)
    does = "meets" if first["meets"].item() else "misses"
    which = f"{named(first)}: {MEASURES[name].noun} {quantity(name, first['value'].item())}"
    if count == 1:
        return f"1 design {does} {name} by less than the uncertainty of its value: {which}."
    every = f"{count} designs meet or miss {name} by less than the uncertainty of their values"
    return f"{every}. The nearest {does} it: {which}."


def _nearest(
    alike: Sequence[Outcome], limits: Mapping[str, float], named: Callable[[DataFrame], str]
) -> Iterator[str]:
    """The nearest design of some budgets, the requirements that it misses, and those that no design
    fulfils.
    """
    outcome, row = alike[-1], alike[-1].nearest
    if row.empty:
        return
    early = bool(row["ends_early"].item())
    parts = [_miss(name, outcome, early) for name in outcome.missed]
    doubt = f" ({DISTRUST.format(_mark(row))})" if doubtful(row).item() else ""
    yield fill(f"Nearest{_within(*alike)}: {named(row)}{doubt}: {'; '.join(parts)}.", WIDTH)
    for name, count in outcome.failed.items():
        best = outcome.best[name]
        mentioned = outcome.missed.get(name) == best.value or not math.isfinite(best.value)
        if count == outcome.designs and not mentioned:
            closest = quantity(name, best.value)
            unsure = " (marked ! or x: do not trust it)" if best.doubtful else ""
            yield f"{MEASURES[name].none.format(quantity(name, limits[name]), closest)}{unsure}."


def _miss(name: str, outcome: Outcome, early: bool) -> str:
    """The value of the nearest design for a requirement, and by how much it is too large or too
    small.
    """
    measure, share = MEASURES[name], percentage(outcome.misses[name])
    value = quantity(name, outcome.missed[name])
    if early and name == "min_absorbed":
        return f"{measure.noun} at least {value}, at most {share.removeprefix(LESS)} {measure.far}"
    return f"{measure.noun} {value}, {share} {measure.far}"


def percentage(share: float) -> str:
    """A share above zero in percent."""
    return f"{tenths(share)} %" if share >= SMALLEST_SHOWN else f"{LESS}0.1 %"


def _mark(row: DataFrame) -> str:
    """The marks of a doubtful design."""
    return "!" * bool(row["beyond_model"].item()) + "x" * bool(row["crossed"].item())


def _rectangle(outcome: Outcome) -> Iterator[str]:
    """The least stroke for an energy at a force, if both are known."""
    if math.isfinite(outcome.stroke):
        energy, force = energy_text(outcome.energy), quantity("max_force", outcome.force)
        stroke, height = (
            f"{three_digits(in_unit(x, 'mm'))} mm" for x in (outcome.stroke, outcome.height)
        )
        yield (
            f"Absorbing {energy} at no more than {force} takes a stroke of at least {stroke} "
            f"(energy / force);\nthe lattice is {height} high."
        )


def requirement_columns(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    """Columns of required or sorted quantities that a table does not have by itself.

    A limit of the force shows the stroke that stays below it.
    """
    columns = {}
    struck = rows["striker_mass_g"].notna().any()
    for head, (name, column) in FELT.items():
        if struck and (name in ranking.required or column in {*rows["ranked_by"]}):
            columns[head] = numerals(in_unit(rows[column], MEASURES[name].shown))
    mode, limits = mode_of(rows), ranking.required
    limited = mode.driven and (ranking.limited or "max_force" in limits)
    shown = limited or ("max_stroke" in limits and "max_stroke" in mode.requires)
    if shown and rows["counted_stroke_m"].notna().any():
        columns["stroke mm"] = numerals(in_unit(rows["counted_stroke_m"], "mm"))
    return columns


def column_notes(ranking: Ranking) -> list[str]:
    """Explanations of the columns of `requirement_columns`."""
    scenes = [rows for _, rows in ranking.table.groupby("scene", sort=False)]
    shown = {head for rows in scenes for head in requirement_columns(rows, ranking)}
    return [line for head, line in COLUMN_NOTES.items() if head in shown]


def panel_column(rows: DataFrame) -> dict[str, Series]:
    """The force of the panel, if there is one."""
    paneled = "panel_force_N" in rows
    return {"panel N": numerals(rows["panel_force_N"])} if paneled else {}


def panel_size(rows: DataFrame) -> dict[str, Series]:
    """The true lengths of the panel, if there is one."""
    if "panel_specimens" not in rows:
        return {}
    lengths = (in_unit(rows[f"panel_{side}_m"], "mm") for side in ("width", "depth"))
    sides = [length.map("{:.3g}".format) for length in lengths]
    return {"panel mm": sides[0] + " x " + sides[1]}


def panel_note(rows: DataFrame, panel: Sequence[float]) -> list[str]:
    """The number of specimens in a panel, what strikes them, and whether the panel differs from
    the lengths (m) of the question; none without a panel.
    """
    if "panel_specimens" not in rows or (has(rows, "dead") | has(rows, "probed")).all():
        return []
    whole = is_period(rows)
    if whole.all():
        return [WHOLE_PANEL.format(next(iter(panel_size(rows)["panel mm"])))]
    rows = rows[~whole]
    least, most = rows["panel_specimens"].min(), rows["panel_specimens"].max()
    sizes = list(dict.fromkeys(panel_size(rows.sort_values("panel_width_m"))["panel mm"]))
    size = sizes[0] if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    struck = [STRUCK_PANEL] if has(rows, "struck").any() else []
    other = _other_size(rows, panel)
    if most == 1:
        return [ONE_SPECIMEN.format(size), *other]
    unequal = [UNEQUAL] if least < most else []
    count = f"{least:.0f} to {most:.0f}" if unequal else f"{least:.0f}"
    return [PANEL.format(count, size), *unequal, *other, *struck]


def _other_size(rows: DataFrame, panel: Sequence[float]) -> Iterator[str]:
    """A sentence if whole specimens make a panel of another size than the question has."""
    sides = rows[["panel_width_m", "panel_depth_m"]]
    if (difference := float((sides / list(panel) - 1.0).abs().max(axis=None))) > TOLERATED:
        lengths = " x ".join(f"{in_unit(side, 'mm'):.4g}" for side in panel)
        yield OTHER_SIZE.format(percent(difference), lengths)
