"""Loading scenes: which cases are compared, and the names of their loadings."""

from collections.abc import Iterable

import numpy as np
from pandas import DataFrame, Series, to_numeric

from sweep.columns import describe_column
from sweep.loading_modes import MODES, has, mode_of
from sweep.numbers import NOTHING, short, text_in, with_unit
from sweep.ranking.merit import is_period, pressed_area

SCENE = [
    *("loading_mode", "platen", "striker", "base"),
    *(column for mode in MODES.values() for column in mode.scene),
]
HELD_BY_SCENE = tuple(
    f"loading.{key}"
    for key in (
        *("mode", "direction", "platen", "force", "allowed_forces", "strain", "stroke"),
        *("striker_mass", "striker_speed", "energy", "drop_height", "preset", "specimens"),
        *("gravity", "target_mass"),
        *(f"striker{part}" for part in ("", "_at", "_radius", "_angle", "_tip", "_width")),
        *("base", "base_span", "base_radius"),
    )
)
STRAIN_DIGITS = 6
DIGITS = (4, 6, 10, 17)
"""Digits of the numbers of a label: more, where labels of scenes are the same with fewer."""
ROUND_OFF = 1e-9  # relative difference up to which numbers of a scene are the same

ASSUMPTIONS = (
    "loading.",
    "contact.",
    "damping.",
    "solver.",
    "lattice.nodes_per_wall",
    "lattice.layers",
    "lattice.symmetry",
    "lattice.imperfection",
    "material.stretch",
    "material.bend",
    "material.plane",
    "material.poisson",
)
"""Grid keys of the test and not of the design: every value of them makes a scene of its own."""
OF_DESIGN = ("loading.direction",)
"""Keys of the loading that belong to the design nevertheless: how a panel is laid."""


def by_scene(frame: DataFrame, labels: Series | None = None) -> dict[str, DataFrame]:
    """The rows of each loading scene by its label, in the order in which scenes first appear.

    labels: `scene_labels` of a table with these rows and others. Without rows, the label is "".
    """
    names = scene_labels(frame) if labels is None else labels[frame.index]
    return dict(list(frame.groupby(names, sort=False))) or {"": frame}


def scene_labels(frame: DataFrame) -> Series:
    """The label of the loading scene of each row: the same for all rows of a scene, and for no
    other row.

    Labels that are the same with four digits get more of them, and then the keys that differ.
    """
    values = _values(frame)
    number = values.groupby(list(values), dropna=False, sort=False).ngroup()
    first = ~number.duplicated()
    rows, values = (each[first].set_axis(number[first]) for each in (frame, values))
    labels = Series("", rows.index, dtype=object)
    for digits in DIGITS:
        for scene in labels.index[labels.duplicated(keep=False) | (labels == "")]:
            labels[scene] = scene_label(rows.loc[[scene]], digits)
    for _, alike in labels[labels.duplicated(keep=False)].groupby(labels):
        keys = [key for key in values if len(values.loc[alike.index, key].unique()) > 1]
        for scene in alike.index:
            labels[scene] = ", ".join(
                [labels[scene], *key_words(rows.loc[scene], keys, DIGITS[-1])]
            )
    return number.map(labels)


def _values(frame: DataFrame) -> DataFrame:
    """The values that define the scene of each row: its keys, how far a crush is pressed, and the
    area of a panel on which a load or a striker acts.
    """
    driven = has(frame, "driven")
    strain = (frame["stroke_m"] / frame["height_m"]).where(driven)
    area = pressed_area(frame).where(is_period(frame) & ~driven)
    columns = {key: frame[key] for key in scene_keys(frame)} | {"strain": strain, "area": area}
    return DataFrame({key: _alike(column) for key, column in columns.items()}, index=frame.index)


def _alike(values: Series) -> Series:
    """Texts, and the same integer for numbers that differ by round-off; NaN for no value.

    A column whose values are all the same stays as it is.
    """
    if len(values.unique()) == 1:
        return values
    numbers = to_numeric(values, errors="coerce").astype(float).to_numpy()
    order = np.argsort(numbers)
    lesser, greater = numbers[order[:-1]], numbers[order[1:]]
    groups = np.zeros(len(numbers), int)
    groups[order[1:]] = np.cumsum(greater > lesser + ROUND_OFF * abs(lesser))
    texts = values.astype(object).where(values != "")
    return texts.where(np.isnan(numbers), groups)


def scene_keys(frame: DataFrame) -> list[str]:
    """Columns that define a loading scene besides the strain of a crush; rows that differ in one of
    them are not compared.
    """
    assumed = [key for key in frame if key.startswith(ASSUMPTIONS) and key not in HELD_BY_SCENE]
    return [key for key in SCENE if key in frame] + assumed


def _standing(row: Series) -> list[str]:
    """The striker or platen that presses the lattice of a row and the base that carries it, in
    words.
    """
    platen, striker, base = row["platen"], row["striker"], row["base"]
    plain = striker == "flat" and base == "flat"
    if plain:
        return ["no platens" if platen in ("none", "") else f"{platen} platens"]
    shapes = [f"striker {striker}"] if striker != "flat" else ["flat striker"]
    return [*shapes, f"{platen} base" if base == "flat" else f"on {base}"]


def scene_label(rows: DataFrame, digits: int = DIGITS[0]) -> str:
    """The loading of the cases of one scene, in words; `scene_labels` differ between scenes.

    Keys that the scene does not use are left out.
    """
    if rows.empty:
        return ""
    first, mode = rows.iloc[0], mode_of(rows)
    words = [mode.title(first, digits)]
    if mode.driven:
        strain = text_in(first["stroke_m"] / first["height_m"], "%", max(digits, STRAIN_DIGITS))
        words[0] += f" to {strain}"
    elif is_period(rows[:1]).all():
        area = float(pressed_area(rows[:1]).iloc[0])
        words[0] += f" on {text_in(area, 'mm2', digits)} of a panel"
    if not mode.probed:
        words += _standing(first)
    keys = [key for key in scene_keys(rows) if key not in SCENE]
    used = [key for key in keys if short(first[key]) not in ("", NOTHING)]
    return ", ".join([*words, *key_words(first, used, digits)])


def key_words(row: Series, keys: Iterable[str], digits: int = DIGITS[0]) -> list[str]:
    """Keys of a row with their values."""
    values = {key: with_unit(row[key], describe_column(key).units, digits) for key in keys}
    return [f"{key.replace('.', ' ').replace('_', ' ')} {value}" for key, value in values.items()]
