"""What was required of the designs, and how many fail which requirement, in sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from sweep.numbers import energy_text, numerals, three_digits
from sweep.ranking.merit import greatest_mass
from sweep.ranking.requirements import STANDARD_GRAVITY

if TYPE_CHECKING:
    from pandas import DataFrame, Series

    from sweep.ranking.ranking import Ranking
    from sweep.ranking.requirements import Outcome

PANEL = "panel N: force of the {} specimens of a panel together. Its true size is {} mm."
UNKNOWN = {
    "max_deceleration": "rows are too far apart for loading.filter_class, or older than the filter",
    "max_force": "it has not been measured",
    "max_mass": "it has not been measured",
    "min_absorbed": "it has not been measured",
    "max_stroke": "it has not been measured",
}


class Words(NamedTuple):
    """How a requirement is written. limit: "force at most 60 N"; none: why nothing fulfils it."""

    limit: str
    none: str


WORDS = {
    "max_force": Words("force at most {}", "None passes less than {}; the best is {}."),
    "max_deceleration": Words(
        "deceleration at most {}", "None stops the striker with less than {}; the best needs {}."
    ),
    "max_mass": Words("mass at most {}", "None weighs less than {}; the lightest weighs {}."),
    "min_absorbed": Words(
        "absorbed energy at least {}", "None absorbs as much as {}; the most is {}."
    ),
    "max_stroke": Words("stroke at most {}", "None needs less stroke than {}; the least is {}."),
}


def quantity(name: str, value: float, digits: int = 4) -> str:
    """The value of a requirement (SI) in the unit of a maker."""
    if name == "min_absorbed":
        return energy_text(value)
    scale, unit = {
        "max_force": (1.0, "N"),
        "max_deceleration": (1.0 / STANDARD_GRAVITY, "g0"),
        "max_mass": (1e3, "g"),
        "max_stroke": (1e3, "mm"),
    }[name]
    return f"{float(f'{scale * value:.{digits}g}'):g} {unit}"


def required(ranking: Ranking) -> str:
    """All requirements in one sentence; empty without any."""
    limits = [WORDS[k].limit.format(quantity(k, v)) for k, v in ranking.required.items()]
    return f"Required of a {ranking.per}: {', '.join(limits)}." if limits else ""


def titled(title: str, ranking: Ranking) -> str:
    """The title of a picture with the requirements on a line of their own."""
    return "\n".join(filter(None, [title, required(ranking)]))


def requirement_notes(scene: str, placed: DataFrame, ranking: Ranking) -> Iterator[str]:
    """Sentences about the requirements in one scene: what they are, who fails, what is missing.

    placed: the designs of the scene that have a place.
    """
    outcome = ranking.outcomes.get(scene)
    if outcome is None:
        return
    yield required(ranking)
    yield _counts(outcome)
    for name, count in outcome.unknown.items():
        if count:
            yield f"{count} without a value for {name}: {UNKNOWN[name]}."
    for name in outcome.left_out:
        yield f"{name} is not asked for here: there is no striker."
    lightest = ranking.lightest_g[scene]
    for budget in ranking.budgets_g if outcome.fulfil else ():
        if greatest_mass(budget) >= lightest and not (placed["budget_g"] == budget).any():
            yield f"None of these weighs {budget:g} g or less."
    yield from _out_of_reach(outcome, ranking.required)
    if not outcome.fulfil:
        yield from _nearest(outcome)


def _counts(outcome: Outcome) -> str:
    """How many designs fulfil all requirements, and how many fail each."""
    failing = outcome.designs - outcome.fulfil
    if not failing:
        return f"All designs ({outcome.designs}) fulfil this."
    parts = [f"{name} ({count})" for name, count in outcome.failed.items() if count]
    several = "; some fail several" if sum(outcome.failed.values()) > failing else ""
    fulfil = f"{outcome.fulfil} of {outcome.designs} designs fulfil this"
    return f"{fulfil}; {failing} fail: {', '.join(parts)}{several}."


def _out_of_reach(outcome: Outcome, limits: Mapping[str, float]) -> Iterator[str]:
    """A sentence for each requirement that no design fulfils, and the least stroke for a force."""
    for name, count in outcome.failed.items():
        if count == outcome.designs and math.isfinite(outcome.best[name]):
            found = quantity(name, outcome.best[name], digits=3)
            yield WORDS[name].none.format(quantity(name, limits[name]), found)
    if not outcome.fulfil and math.isfinite(outcome.stroke):
        energy, force = energy_text(outcome.energy), quantity("max_force", outcome.force)
        stroke, height = (f"{three_digits(1e3 * x)} mm" for x in (outcome.stroke, outcome.height))
        yield (
            f"{energy} at {force} needs at least {stroke} of stroke, if the force is constant:\n"
            f"energy / force, a rectangle, which no real curve is. The lattice is {height} high."
        )


def _nearest(outcome: Outcome) -> Iterator[str]:
    """The design that comes nearest to all requirements together, if there are several."""
    case_id, values = outcome.nearest
    if len(values) > 1:
        nouns = {name: WORDS[name].limit.rsplit(" at ", 1)[0] for name in values}
        parts = [f"{nouns[k]} {quantity(k, v, digits=3)}" for k, v in values.items()]
        yield f"The nearest to all of this is case {case_id}: {', '.join(parts)}."


def requirement_columns(rows: DataFrame, ranking: Ranking) -> dict[str, Series]:
    """Columns of what is required that a table does not have by itself."""
    columns = {}
    if "max_deceleration" in ranking.required and rows["striker_mass_g"].notna().any():
        filtered = rows["peak_deceleration_filtered_m_per_s2"]
        columns["decel. g0"] = numerals(filtered / STANDARD_GRAVITY)
    if "max_stroke" in ranking.required:
        columns["stroke mm"] = numerals(1e3 * rows["counted_stroke_m"])
    return columns


def panel_column(rows: DataFrame) -> dict[str, Series]:
    """The force of the panel, where there is one."""
    known = "panel_force_N" in rows
    return {"panel N": numerals(rows["panel_force_N"])} if known else {}


def panel_size(rows: DataFrame) -> dict[str, Series]:
    """The true lengths of the panel, where there is one."""
    if "panel_specimens" not in rows:
        return {}
    sides = [(1e3 * rows[f"panel_{side}_m"]).map("{:.3g}".format) for side in ("width", "depth")]
    return {"panel mm": sides[0] + " x " + sides[1]}


def panel_note(rows: DataFrame) -> list[str]:
    """How many specimens a panel has; none without a panel."""
    if "panel_specimens" not in rows:
        return []
    least, most = rows["panel_specimens"].min(), rows["panel_specimens"].max()
    sizes = list(dict.fromkeys(panel_size(rows.sort_values("panel_width_m"))["panel mm"]))
    size = sizes[0] if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    return [PANEL.format(least if least == most else f"{least} to {most}", size)]
