"""Other names of keys and of their choices, as slicers and users call them."""

from collections.abc import Iterable
from typing import Any

from sweep.config.keys import nearest

CHOICES: dict[str, dict[str, str]] = {
    "lattice.kind": {
        "honeycomb": "hex",
        "hexagon": "hex",
        "hexagons": "hex",
        "hexagonal": "hex",
        "grid": "square",
        "squares": "square",
        "bricks": "brick",
        "auxetic": "reentrant",
        "re-entrant": "reentrant",
        "bowtie": "reentrant",
        "rhombus": "diamond",
        "diamonds": "diamond",
        "circles": "circle",
        "triangles": "triangle",
        "triangular": "triangle",
        "isogrid": "triangle",
        "stars": "kagome",
        "trihexagon": "kagome",
        "tri-hexagon": "kagome",
    },
    "lattice.slicer": {
        "prusaslicer": "prusa",
        "prusa slicer": "prusa",
        "superslicer": "prusa",
        "slic3r": "prusa",
        "orcaslicer": "orca",
        "orca slicer": "orca",
        "bambu": "orca",
        "bambustudio": "orca",
        "bambu studio": "orca",
        "bambulab": "orca",
        "ultimaker cura": "cura",
    },
    "lattice.pattern": {
        "2dlattice": "lateral-lattice",
        "2d lattice": "lateral-lattice",
        "laterallattice": "lateral-lattice",
        "lateral lattice": "lateral-lattice",
        "2dhoneycomb": "lateral-honeycomb",
        "2d honeycomb": "lateral-honeycomb",
        "lateralhoneycomb": "lateral-honeycomb",
        "lateral honeycomb": "lateral-honeycomb",
    },
    "loading.mode": {
        "crush": "displacement",
        "compression": "displacement",
        "dead load": "force",
        "load": "force",
    },
    "loading.platen": {"loose": "contact", "bonded": "glued"},
}
"""Understood words -> the choice, by key."""

KEYS = {
    "fall_height": ("loading.drop_height", ""),
    "height_of_fall": ("loading.drop_height", ""),
    "drop_mass": ("loading.striker_mass", ""),
    "impact_speed": ("loading.striker_speed", ""),
    "impact_energy": ("loading.energy", ""),
    "compression": ("loading.strain", "the share of the height by which the lattice is crushed"),
    "displacement": ("loading.stroke", "the way of the platen"),
    "load": ("loading.force", ""),
    "mass": ("loading.striker_mass", ""),
    "max_force": ("loading.allowed_forces", "a list"),
    "thickness": ("lattice.wall_thickness", ""),
    "infill_pattern": ("lattice.pattern", "with lattice.slicer; without a slicer, lattice.kind"),
    "infill_density": ("lattice.infill", ""),
    "infill_sparse_density": ("lattice.infill", ""),
    "sparse_infill_density": ("lattice.infill", ""),
    "sparse_infill_pattern": ("lattice.pattern", "with lattice.slicer"),
    "fill_pattern": ("lattice.pattern", "with lattice.slicer"),
    "infill_line_distance": ("lattice.line_distance", "with lattice.slicer"),
    "infill_multiplier": ("lattice.fill_multiline", "the lines of a wall"),
    "line_multiplier": ("lattice.fill_multiline", "the lines of a wall"),
    "infill_angle": ("lattice.fill_angle", ""),
    "infill_direction": ("lattice.fill_angle", ""),
    "wall_line_count": ("lattice.perimeters", ""),
    "walls": ("lattice.perimeters", ""),
    "fill_density": ("lattice.infill", ""),
    "wall_loops": ("lattice.perimeters", ""),
    "top_layers": ("lattice.solid_layers", "layers at the top and at the bottom"),
    "bottom_layers": ("lattice.solid_layers", "layers at the top and at the bottom"),
    "weight": ("lattice.mass", ""),
    "youngs_modulus": ("material.modulus", ""),
    "filament": ("material.name", ""),
    "material.file": ("material.name", "of one that is shipped, or the path of a .csv file"),
    "dt": ("solver.time_step", ""),
    "mu": ("contact.friction", ""),
    "budget": ("rank.budgets", "a list"),
}
"""Key that a user may think of, alone or in its table -> the key of a config, and a note."""


def present_choice(key: str, raw: Any) -> Any:
    """The choice that a word means for a key, regardless of case; other values are unchanged."""
    if not isinstance(raw, str) or key not in CHOICES:
        return raw
    words, word = CHOICES[key], raw.lower()
    return word if word in words.values() else words.get(word, raw)


def with_words(key: str, allowed: str) -> str:
    """The choices of a key with the first other word for each: "displacement" ("crush")."""
    for choice in dict.fromkeys(CHOICES.get(key, {}).values()):
        word = next(word for word, other in CHOICES[key].items() if other == choice)
        if not word.startswith(choice):
            allowed = allowed.replace(f'"{choice}"', f'"{choice}" ("{word}")')
    return allowed


def meant(name: str, candidates: Iterable[str]) -> tuple[str, str]:
    """The known key that an unknown one means, and a clause that says so."""
    names = list(candidates)
    word = name.lower()
    key, note = KEYS.get(word) or KEYS.get(word.rpartition(".")[2], ("", ""))
    near = key if key in names else nearest(name, names)
    return near, f"the nearest is {near}" + (f": {note}" if note and near == key else "")
