"""The modes of loading, with all that rankings, tables, pictures, the page and exports need of
each.

A results table names the mode of a row in `loading_mode`. A new mode is a row of `MODES`; its kind
in `sweep/config/kinds` has the keys. No heavy imports, as every command reads this.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isnan, nan
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from sweep.numbers import energy_text, short

if TYPE_CHECKING:
    from pandas import DataFrame, Series

Row = Mapping[str, Any]


class Axis(NamedTuple):
    """A column of the history on an axis: its unit there, and its label."""

    column: str
    unit: str
    label: str


class Least(NamedTuple):
    """A measure that is compared instead of energy, where the loading sets the energy.

    Under a dead load, the design that deforms most absorbs most energy. Every design absorbs all
    the energy of a striker; designs differ in the force on the support, which is large if the
    stroke is used up.

    column: the least value is the best. unit: in charts. axis, chart: label of an axis, title of a
    chart. quantity: on the axis of the page. merit: words for a value. order: the best value, in
    words. front: what no lighter design does, if a design is on the Pareto front. head: of its
    column on the page.
    """

    column: str
    unit: str
    axis: str
    chart: str
    quantity: str
    merit: str
    order: str
    front: str
    head: str


class Coarse(NamedTuple):
    """What tells that load or time steps are too long.

    column: measure of the error that they make, NaN of loadings without such steps; above the value
    ``most`` a result has a mark, as errors of the compared column often exceed the differences of
    similar designs (`sweep.simulation.load_step_error`, `time_resolution`). If ``most`` is NaN, a
    column that is NaN where steps are too long for it. steps, whole: which steps, and what the
    measure is a share of, in words; keys: the keys that make steps shorter; effect: what errs.
    """

    column: str
    most: float
    steps: str
    whole: str
    keys: str
    effect: str = "Energies and strains may err by several times that, peak forces by\nmore."


class Mode(NamedTuple):
    """The properties of one mode of loading.

    noun: the loading in words; without: why a requirement does not apply to it. requires: the
    requirements whose values the design sets, not the loading. title: the loading of a row in
    words. curve: abscissa and ordinate of its curve. columns: its own columns of results; scene:
    columns whose values distinguish scenes.

    driven: a platen moves by a stroke, so that energy counts until densification and force over
    travel is a curve. dead: a constant force, removed at the end. struck: a striker brings the
    energy. probed: curves of probes, without platens and strain.

    least: the measure compared instead of energy. coarse: what tells that steps are too long.

    In words: turn, the end of its loading; total, the sum of all energies; energy and path, the
    quantities whose accuracy is measured. notes: meaning of columns of tables. picture: name of the
    chart of merit over mass; empty if there is none.
    """

    noun: str
    without: str
    requires: tuple[str, ...]
    title: Callable[[Row, int], str]
    curve: tuple[Axis, Axis]
    columns: tuple[str, ...] = ()
    scene: tuple[str, ...] = ()
    driven: bool = False
    dead: bool = False
    struck: bool = False
    probed: bool = False
    least: Least | None = None
    coarse: tuple[Coarse, ...] = ()
    turn: str = "standstill"
    total: str = "work done"
    energy: str = "absorbed energy"
    path: str = "strain over time"
    notes: tuple[str, ...] = ()
    picture: str = ""


STRIKER = ("striker_mass_g", "striker_speed_m_per_s", "target_mass_g")
STRAIN = Axis("strain", "%", "strain, %")
TIME = Axis("time_s", "ms", "time, ms")
LOADED = "strain: greatest strain under the load, including overshoot."
STRUCK = """\
force: greatest force on the support, filtered (loading.filter_class). strain: greatest strain.
left: stroke left until all voids are closed. rebound: energy of the striker, relative to the base,
at rebound / at first contact."""
PROBED = "absorbed: work done on the structure until the end of its loading; J/g is of it."
DENSIFIED = """\
dens.: densification strain, at which energy / greatest force is greatest: the mean of the strains
at which it is nearly as great. Energy and peak until then are means over the same strains."""


def _struck(row: Row, digits: int) -> str:
    """The striker of a row and its target, in words."""
    mass, speed, target = (short(float(row[name]), digits) for name in STRIKER)
    energy = energy_text(float(row["impact_energy_J"]))
    falls = " under gravity" if row["gravity"] == 1.0 else ""
    free = f" on a target of {target} g" if float(row["target_mass_g"]) > 0.0 else ""
    return f"struck by {mass} g at {speed} m/s ({energy}){falls}{free}"


MODES: Mapping[str, Mode] = {
    "displacement": Mode(
        noun="a crush",
        without="a crush, which has no striker",
        requires=("max_force", "max_mass", "min_absorbed", "max_stroke"),
        title=lambda *_: "crushed",
        curve=(STRAIN, Axis("reaction_top_N", "N", "force, N")),
        columns=("stroke_m",),
        driven=True,
        coarse=(
            Coarse(
                *("load_step_error", 0.005, "load steps", "the work"),
                keys="solver.accuracy or load_steps",
            ),
            Coarse(
                *("peak_step_error", 0.02, "load steps", "a peak force"),
                keys="solver.accuracy or more load_steps",
                effect="Densification, and energies until then, may err as much,\n"
                "those up to a force near the peak far more.",
            ),
            Coarse(
                *("integrator_share", 0.01, "time steps", "the work"),
                keys="solver.step_error or time_step",
            ),
            Coarse(
                *("peak_force_N", nan, "time steps", "the greatest force (–)"),
                keys="solver.time_step",
                effect="Densification, and energies until\n"
                "then or up to a force, may err by a tenth or more.",
            ),
        ),
        turn="reversal",
        path="force along the way",
        notes=(DENSIFIED,),
        picture="absorption",
    ),
    "impact": Mode(
        noun="an impact",
        without="an impact, whose striker sets the energy",
        requires=(
            *("max_force", "max_deceleration", "max_base_pressure", "max_target_acceleration"),
            *("max_mass", "max_stroke"),
        ),
        title=_struck,
        curve=(STRAIN, Axis("reaction_bottom_N", "N", "force on the support, unfiltered, N")),
        columns=(
            *("striker_mass_g", "striker_speed_m_per_s", "impact_energy_J", "gravity"),
            "target_mass_g",
        ),
        scene=(*STRIKER, "gravity"),
        struck=True,
        least=Least(
            *("peak_force_N", "N", "greatest force on the support, filtered, N", "Force over mass"),
            quantity="force on the support",
            merit="{} N on the support",
            order="least force on the support",
            front="transmits as little force",
            head="force N",
        ),
        coarse=(
            Coarse(
                *("integrator_share", 0.01, "time steps", "the impact energy"),
                keys="solver.step_error or time_step",
            ),
            Coarse(
                *("peak_deceleration_filtered_m_per_s2", nan, "time steps", "peaks of the force"),
                keys="solver.time_step",
                effect="The greatest may be a quarter more than shown.",
            ),
        ),
        total="brought by the striker",
        notes=(STRUCK,),
        picture="passed_on",
    ),
    "force": Mode(
        noun="a dead load",
        without="a dead load, which sets force and energy itself",
        requires=("max_mass", "max_stroke"),
        title=lambda row, digits: f"dead load of {short(row['force_N'], max(digits, 6))} N",
        curve=(TIME, STRAIN),
        columns=("force_N",),
        scene=("force_N",),
        dead=True,
        least=Least(
            *("peak_strain", "%", "greatest strain, %", "Strain over mass"),
            quantity="greatest strain",
            merit="compressed by {} %",
            order="smallest strain",
            front="is strained as little",
            head="strain %",
        ),
        coarse=(
            Coarse(
                *("path_error", 0.005, "time steps", "the path of the top"),
                keys="solver.step_error or time_step",
            ),
        ),
        turn="load removed",
        notes=(LOADED,),
        picture="sink",
    ),
    "custom": Mode(
        noun="a custom structure",
        without="a custom structure",
        requires=("max_mass",),
        title=lambda *_: "loaded as in its file",
        curve=(TIME, Axis("reaction_bottom_N", "N", "force, N")),
        probed=True,
        energy="energy left",
        path="motion of the probes",
        notes=(PROBED,),
    ),
}
"""By `loading_mode`."""


def mode_of(rows: DataFrame) -> Mode:
    """The mode of the rows of one scene, which is the same for all."""
    return MODES[rows["loading_mode"].iloc[0]]


def compared(rows: DataFrame) -> str | None:
    """The column that is compared instead of energy in one scene; None if energy is, or without
    rows.
    """
    return least.column if len(rows) and (least := mode_of(rows).least) else None


def has(rows: DataFrame, trait: Literal["driven", "dead", "struck", "probed"]) -> Series:
    """Row by row, whether its mode has a trait."""
    return rows["loading_mode"].isin([name for name, mode in MODES.items() if getattr(mode, trait)])


def is_coarse(rows: DataFrame) -> Series:
    """Whether steps are too long by a measure of `Mode.coarse`, row by row."""
    coarse = rows["loading_mode"] == ""
    for name, mode in MODES.items():
        for measure in mode.coarse:
            coarse |= (rows["loading_mode"] == name) & exceeds(rows, measure)
    return coarse


def exceeds(rows: DataFrame, measure: Coarse) -> Series:
    """Whether steps are too long by one measure, row by row."""
    values = rows[measure.column]
    return values.isna() if isnan(measure.most) else values > measure.most


def applies_to(requirement: str) -> tuple[str, ...]:
    """The modes to which a requirement applies."""
    return tuple(name for name, mode in MODES.items() if requirement in mode.requires)
