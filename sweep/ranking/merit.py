"""The merit of a design: its usable energy, in total, per gram, and for a panel of specimens.

Energy is counted until densification, or until the force exceeds the allowed force. A lattice
pressed beyond densification absorbs energy as a solid block does, at a multiple of the force,
whatever its infill. If the loading sets the energy, `Mode.least` is compared instead.

A panel consists of n whole specimens, as `sweep.design.panel` counts them; its mass, energy and
force are n times the values of a specimen.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from pandas import DataFrame, Series, concat

from sweep.columns import (
    ABSORBED_AT,
    TIED_SIDES,
    absorbed_energy_column,
    correction_column,
    describe_column,
    end_columns,
    error_column,
)
from sweep.design.panel import BEHIND, Panel, panel_of, too_small
from sweep.loading_modes import applies_to, has, is_coarse
from sweep.numbers import text_in
from sweep.ranking.budget import ROUND_OFF, counted_mass
from sweep.ranking.question import Quantity, Question, RankError, in_si
from sweep.ranking.requirement_table import MEASURES
from sweep.result import sides_of

if TYPE_CHECKING:
    from sweep.config.case import Case

WHOLE_CRUSH = (
    *("absorbed_energy_J", "specific_absorption_J_per_g", "returned_energy_J"),
    *("lost_energy_J", "lost_energy_J_per_g", "dissipated_energy_J"),
    *("peak_force_N", "peak_base_pressure_Pa"),
)
"""Columns that a crush beyond densification changes: a ranking by one of them needs all of it."""
AT_DENSIFICATION = (
    "absorbed_energy_at_densification_J",
    "specific_absorption_at_densification_J_per_g",
)
UNTIL_PACKED = "absorbed_energy_until_packed_J"
AT_ALLOWED = "absorbed_energy_at_allowed_J"
STROKE_AT_ALLOWED = "stroke_at_allowed_m"
SEVEN_DIGITS = 1e-6  # relative round-off of `AT_ALLOWED`, as stored curves have single precision
SAME_AREA = 1e-6  # relative difference of the areas of equal periods
SUMMED = ("N", "J", "g", "kg")  # units of what specimens of a panel have together
UNEQUAL = (
    "periods of wide panels differ in area here, from one another or from whole parts, "
    "and so in force, energy and mass"
)


class Compared(NamedTuple):
    """Names of the compared columns; `until`: up to which point energy is counted, in words."""

    mass: str
    energy: str
    per_gram: str
    until: str


def merits(finished: DataFrame, question: Question) -> tuple[DataFrame, Compared]:
    """Rows with the compared columns added, and the names of these columns.

    A budget counts the mass as extruded where there is a slicer (`counted_mass_g`).

    Other added columns: `passed_on_N`, the greatest force while that energy is absorbed, and
    `panel_force_N`; `counted_stroke_m`; `returned_share`, returned energy / work of the whole
    crush; `ends_early`; `beyond_model`; `crossed`; `coarse`; `beyond_curve`; the ends of the
    range for which the energy stands (`_ends`); and errors and corrections of added columns, if
    the energy has them.
    """
    filled = None if question.panel is None else panel_in(finished, question.panel)
    count = None if filled is None else filled.specimens
    energy, force, until = _counted(finished, question, count)
    per_gram = f"{energy}_per_g".replace("absorbed_energy", "specific_absorption")
    mass, grams = counted_mass(finished)
    limited = question.allowed_force is not None
    round_off = SEVEN_DIGITS if energy == AT_ALLOWED else ROUND_OFF
    within = finished["absorbed_energy_within_model_J"] * (1.0 + round_off)
    needed = finished["absorbed_energy_J" if question.by in WHOLE_CRUSH else energy]
    added = {
        mass: grams,
        per_gram: finished[energy] / grams,
        "passed_on_N": force,
        "counted_stroke_m": _stroke(finished, energy, limited),
        "returned_share": finished["returned_energy_J"] / finished["absorbed_energy_J"],
        "ends_early": _ends_early(finished, energy, force, limited),
        "beyond_model": (needed > within) | through_solid(finished),
        "crossed": finished["max_crossings"] > 0,
        "coarse": is_coarse(finished),
        "beyond_curve": finished["stretch_over_curve"] > 1.0,
    }
    for k, end in enumerate([] if limited else _ends(finished, energy)):
        added |= {end_columns(energy)[k]: end, end_columns(per_gram)[k]: end / grams}
        added |= {} if count is None else {end_columns("panel_energy_J")[k]: count * end}
    for column in (error_column, correction_column):
        if (energy_bar := column(energy)) in finished:
            borne = finished[column(str(force.name))]
            added[column(per_gram)] = finished[energy_bar] / grams
            added[column("passed_on_N")] = borne
            if count is not None:
                whole = finished.get(column("peak_force_N"), borne * float("nan"))
                added[column("panel_energy_J")] = count * finished[energy_bar]
                added[column("panel_force_N")] = count * _of_crush(finished, borne, whole)
    names = Compared(mass, energy, per_gram, until)
    if filled is not None:
        added |= _of_panel(finished, filled, energy, force, grams)
        names = names._replace(mass="panel_mass_g", energy="panel_energy_J")
    others = finished.drop(columns=list(added), errors="ignore")
    return concat([others, DataFrame(added, finished.index)], axis=1), names


def _of_panel(
    finished: DataFrame, filled: Panel, energy: str, force: Series, grams: Series
) -> dict[str, Series]:
    """The columns of a panel: its size, and the total mass, energy and force of its specimens."""
    count = filled.specimens
    return {
        "panel_specimens": count,
        "panel_width_m": filled.width,
        "panel_depth_m": filled.depth,
        "panel_force_N": count * _of_crush(finished, force, finished["peak_force_N"]),
        "panel_mass_g": count * grams,
        "panel_energy_J": count * finished[energy],
    }


def _ends(finished: DataFrame, energy: str) -> tuple[Series, ...]:
    """The least and the greatest energy (J) at maxima of the efficiency that are nearly as high as
    the greatest.

    The range is moved as little as needed to contain ``energy``; there is none to full stroke.
    """
    if energy not in (AT_DENSIFICATION[0], UNTIL_PACKED):
        return ()
    own, (low, high) = (
        finished[energy],
        (finished[name] for name in end_columns(AT_DENSIFICATION[0])),
    )
    length = (high - low).fillna(0.0)
    low = low.fillna(own).clip(own - length, own)
    return low, low + length


def _of_crush(finished: DataFrame, counted: Series, whole: Series) -> Series:
    """For a crush the value until energy is counted, else the value of the whole loading."""
    return counted.where(has(finished, "driven"), whole)


def doubtful(ranked: DataFrame) -> Series:
    """True for designs whose results are beyond the model or have crossing walls."""
    return ranked["beyond_model"].astype(bool) | ranked["crossed"].astype(bool)


def through_solid(finished: DataFrame) -> Series:
    """True for lattices compressed below their solid height, or below zero height."""
    sunk = has(finished, "dead") & (finished["peak_strain"] >= 1.0)  # also without platens
    return sunk | (finished["stroke_left_m"] < -ROUND_OFF)


def panel_in(frame: DataFrame, panel: Sequence[Quantity]) -> Panel:
    """The panel of each design, in whole numbers; for periods, as many as its area holds."""
    if isinstance(panel, str) or len(panel) != 2:
        raise RankError(f'panel = {panel!r}; allowed: two lengths, such as ("100 mm", "50 mm")')
    sides = in_si(panel[0], "m"), in_si(panel[1], "m")
    counts = panel_of(sides, frame["outer_width_m"], frame["depth_m"], gap_behind(frame))
    whole = ~is_period(frame)
    for side, count, one in zip(sides, counts[:2], ("outer_width_m", "depth_m"), strict=True):
        if (whole & (count < 1)).any():
            raise RankError(too_small(side, frame[one][whole].max()))
    if not whole.all():
        return counts
    return counts._replace(across=counts.across.astype(int), behind=counts.behind.astype(int))


def is_period(frame: DataFrame) -> Series:
    """Whether a row is one period of a wide panel."""
    return frame["sides"].str.startswith(TIED_SIDES)


def gap_behind(frame: DataFrame) -> Series:
    """Gap (m) between specimens one behind the other in a panel; NaN for periods."""
    return frame["direction"].map(BEHIND).astype(float).where(~is_period(frame))


def pressed_area(frame: DataFrame) -> Series:
    """The area that is pressed, m^2."""
    return frame["outer_width_m"] * frame["depth_m"]


def unequal_periods(frame: DataFrame) -> bool:
    """Whether some rows are periods of a wide panel, and not all rows have the same area."""
    areas = pressed_area(frame)
    return bool(is_period(frame).any() and areas.max() > (1.0 + SAME_AREA) * areas.min())


def check_budgets(frame: DataFrame, question: Question) -> None:
    """Refuse a budget if it would be compared with the masses of periods."""
    if question.budgets and question.panel is None and is_period(frame).any():
        raise RankError(
            f'budget = "{question.budgets[0]}"; allowed with a panel, such as --panel "100 mm" '
            '"50 mm": here masses are of periods of wide panels, not of parts'
        )


def check_areas(rows: DataFrame, question: Question, required: Mapping[str, float]) -> None:
    """Refuse a question that compares forces, energies or masses of periods of unequal areas, in
    the rows of one scene. required: limits (SI) by name.
    """
    if not unequal_periods(rows):
        return
    mode = rows["loading_mode"].iloc[0]
    limits = {
        name: text_in(limit, MEASURES[name].shown)
        for name, limit in required.items()
        if MEASURES[name].shared and mode in applies_to(name)
    }
    if question.allowed_force is not None:
        limits["allowed_force"] = text_in(in_si(question.allowed_force, "N"), "N")
    if limits and question.per != "panel":
        name, limit = next(iter(limits.items()))
        allowed = 'of a panel: --panel "100 mm" "50 mm" --per panel, or both in [rank]'
        raise RankError(f'{name} = "{limit}"; allowed {allowed}, as {UNEQUAL}')
    by = question.by or ""
    if describe_column(by).units in SUMMED and not by.startswith("panel_"):
        allowed = "a value per gram, or one of a panel, such as panel_energy_J"
        raise RankError(f'cannot sort by "{by}", as {UNEQUAL}\nallowed: {allowed}')


def check_panel(panel: Sequence[Quantity], cases: Iterable[Case]) -> None:
    """Refuse a panel that is smaller than half a specimen of one of these cases."""
    sizes = [(sides_of(case), case.loading.direction, *case.footprint) for case in cases]
    panel_in(DataFrame(sizes, columns=["sides", "direction", "outer_width_m", "depth_m"]), panel)


def _counted(
    finished: DataFrame, question: Question, count: Series | None
) -> tuple[str, Series, str]:
    """The column of the usable energy, the greatest force meanwhile (N), and `Compared.until`.

    count: specimens of a panel, if there is one.
    """
    by, force, of_panel = question.by, question.allowed_force, question.per == "panel"
    if of_panel and count is None:
        raise RankError('per "panel" needs a panel: --panel, or rank.panel in the config')
    if force is not None:
        limit, noun = in_si(force, "N"), "the force of the panel" if of_panel else "the force"
        share = limit / count if of_panel and count is not None else limit
        peak = finished["peak_force_N"].clip(upper=share)
        return _energy_column(finished, limit, of_panel), peak, f"until {noun} exceeds {limit:g} N"
    if by in WHOLE_CRUSH:
        return "absorbed_energy_J", finished["peak_force_N"], "to the end of the stroke"
    if by in AT_DENSIFICATION:
        peak = finished["peak_force_at_densification_N"]
        return AT_DENSIFICATION[0], peak, "up to the strain of greatest efficiency"
    peak = finished["peak_force_until_packed_N"]
    return UNTIL_PACKED, peak, "until densification"


def _stroke(finished: DataFrame, energy: str, limited: bool) -> Series:
    """Stroke (m) in which the usable energy of a crush is absorbed; for other loadings, the
    greatest.

    NaN in a crush up to an allowed force, unless `curves` has added it.
    """
    whole = finished["peak_strain"] * finished["height_m"]
    crushed = has(finished, "driven")
    if limited:
        return finished.get(STROKE_AT_ALLOWED, whole * float("nan")).where(crushed, whole)
    if energy == AT_DENSIFICATION[0]:
        strain = finished["densification_strain"].fillna(finished["peak_strain"])
    else:
        strain = finished["peak_strain" if energy == WHOLE_CRUSH[0] else "packing_strain"]
    return (strain * finished["height_m"]).where(crushed, whole)


def _ends_early(finished: DataFrame, energy: str, force: Series, limited: bool) -> Series:
    """True for crushes that would absorb more than the usable energy if they were longer: they
    ended before the allowed force was exceeded, or before densification.
    """
    crushed = has(finished, "driven")
    if limited:
        return crushed & (finished["peak_force_N"] <= force)
    unpacked = finished["densification_strain"].isna() & finished["peak_strain"].notna()
    return crushed & unpacked & (energy != WHOLE_CRUSH[0])


def _energy_column(frame: DataFrame, force: float, of_panel: bool) -> str:
    """The column of the energy absorbed up to an allowed force (N) of a specimen or of the panel,
    from the sweep or from `curves`.
    """
    name = absorbed_energy_column(force)
    if name in frame and not of_panel:
        return name
    if AT_ALLOWED in frame:
        return AT_ALLOWED
    if of_panel:
        raise RankError(
            "a force of the panel needs the curves of the results: rank the file itself"
        )
    forces = [match[1] for key in frame if (match := ABSORBED_AT.fullmatch(key))]
    allowed = ", ".join(f"{text} N" for text in forces) or "none"
    others = "other forces need the curves of the results: rank the file itself"
    raise RankError(f"no energies up to {force:g} N in this table; allowed: {allowed}; {others}")
