"""Loading scenes: which cases are compared, and the names of their loadings."""

from __future__ import annotations

from pandas import DataFrame, Series

from sweep.columns import describe_column
from sweep.modes import MODES, mode_of
from sweep.numbers import NOTHING, text_in, with_unit

SCENE = [
    *("loading_mode", "platen", "striker", "base"),
    *(column for mode in MODES.values() for column in mode.scene),
]
HELD_BY_SCENE = tuple(
    f"loading.{key}"
    for key in (
        *("mode", "direction", "platen", "force", "allowed_forces"),
        *("striker_mass", "striker_speed", "energy", "drop_height", "preset", "specimens"),
        *("gravity", "target_mass"),
        *(f"striker{part}" for part in ("", "_at", "_radius", "_angle", "_tip", "_width")),
        *("base", "base_span", "base_radius"),
    )
)

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


def by_scene(frame: DataFrame) -> list[DataFrame]:
    """The rows of each loading scene, in the order in which scenes first appear."""
    groups = frame.groupby(scene_keys(frame), dropna=False, sort=False)
    return [rows for _, rows in groups] or [frame]


def scene_keys(frame: DataFrame) -> list[str]:
    """Columns that define a loading scene; rows that differ in one of them are not compared."""
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


def scene_label(rows: DataFrame) -> str:
    """The loading of the cases of one scene, in words; different for every scene.

    Keys that the scene does not use are left out.
    """
    if rows.empty:
        return ""
    first = rows.iloc[0]
    shown = set(SCENE)
    mode = mode_of(rows)
    words = [mode.title(first)]
    if mode.driven and len(strains := (rows["stroke_m"] / rows["height_m"]).round(6).unique()) == 1:
        words[0] += f" to {text_in(strains[0], '%', 6)}"
        shown |= {"loading.strain", "loading.stroke"}
    if not mode.probed:
        words += _standing(first)
    others = {
        key: with_unit(first[key], describe_column(key).units)
        for key in scene_keys(rows)
        if key not in shown
    }
    used = {key: value for key, value in others.items() if value not in ("", NOTHING)}
    words += [f"{key.replace('.', ' ').replace('_', ' ')} {value}" for key, value in used.items()]
    return ", ".join(words)
