"""Draw the scenes of `configs/extreme.toml`: python -m tests.studies.stability.draw FILE

Every scene is drawn by a generator of its own, from its number; an impossible lattice is drawn
again.
"""

import sys
from pathlib import Path

import numpy as np

from sweep.config.case import Case
from sweep.config.keys import case_keys
from sweep.config.kinds.table import TABLES, RefusedError
from sweep.design.lattice import build_network
from sweep.design.network import mass
from tests.support.designs.tables import lattice_with, material_with

COUNT, SEED = 500, 20
MEMORY = 1000  # beyond `COUNT`: first number of a scene with a memory
MOST_NODES = 1200
CONFIGS = Path(__file__).parents[3] / "configs"
SWAY = 0.474  # buckling stress of a square grid / (Y' (t / L)^3), rows swaying
# As in the product when the scenes were drawn: one more would change the scenes.
FAMILIES = "brick", "circle", "diamond", "hex", "kagome", "reentrant", "square", "triangle"
RECORDS = (
    "cheetah",
    "filaflex_60a",
    "ninjaflex",
    "overture_tpu",
    "polymaker_tpu90",
    "ultimaker_tpu95a",
)
ALIKE = {"solver.max_iterations": 500}
HEAD = """\
# Five hundred stiff and extreme scenes, for `make stability`.
#
# Written by `python -m tests.studies.stability.draw configs/extreme.toml`: the ranges stand there.
name = "extreme"

[solver]
max_iterations = 500

[[zip]]
"""


class Draws:
    """Random choices of one scene."""

    def __init__(self, number, seed=SEED):
        self.rng = np.random.default_rng([seed, number])

    def one(self, *choices):
        """One of some values."""
        return choices[self.rng.integers(len(choices))]

    def chance(self, share):
        """True in this share of all draws."""
        return self.rng.random() < share

    def between(self, low, high):
        """A number whose logarithm is even, to three digits."""
        return float(f"{low * (high / low) ** self.rng.random():.3g}")

    def whole(self, low, high):
        """A whole number up to ``high``; small ones are likelier."""
        return min(int(self.between(low + 1.0, high + 2.0)) - 1, high)


def scene(number):
    """Keys of one scene with their values in SI, and its case."""
    draw = Draws(number)
    while True:
        try:
            keys = (
                _material(draw) | _lattice(draw) | _contact(draw) | _damping(draw) | _solver(draw)
            )
            if keys.get("material.bend") == "section":
                keys["solver.bend_measure"] = "angle"
            keys |= _loading(draw, keys)
            return keys, case_of(keys)
        except RefusedError:
            continue


def second_order(number):
    """The case of a scene beyond `COUNT` that moves, by an integrator of second order; or none."""
    keys, case = scene(COUNT + number)
    if case.loading.quasi_static:
        return None
    return case_of(keys | {"solver.integrator": ("bdf2", "newmark")[number % 2]})


def remembering(number):
    """The case of a scene whose material has a memory; its numbers follow the ones of
    `second_order`.
    """
    keys, _ = scene(COUNT + MEMORY + number)
    keys = {key: value for key, value in keys.items() if not key.startswith("damping.")}
    draw = Draws(number, SEED + 1)
    while True:
        try:
            return case_of(keys | _memory(draw, keys))
        except RefusedError:
            continue


def wide(number):
    """The case of 12 to 48 cells side by side, pressed and released; half of them have a loss.

    All families come in turn, between glued and loose platens.
    """
    draw = Draws(number, SEED + 2)
    families = len(FAMILIES)
    cells_x, pitch = 12 * draw.whole(1, 4), draw.between(2e-3, 2e-2)
    keys = {
        "lattice.kind": FAMILIES[number % families],
        "lattice.cells_x": cells_x,
        "lattice.cells_y": 3,
        "lattice.width": float(f"{cells_x * pitch:.3g}"),
        "lattice.height": float(f"{3 * pitch:.3g}"),
        "lattice.depth": pitch,
        "material.name": draw.one(*RECORDS),
        "contact.friction": draw.one(0.0, 0.3, 1.0),
        "loading.mode": "displacement",
        "loading.strain": draw.between(0.3, 0.7),
        "loading.platen": ("glued", "contact")[number // families % 2],
    } | ({"material.loss": draw.between(0.1, 0.7)} if draw.chance(0.5) else {})
    thin = lattice_with(**_values(keys, "lattice"), wall_thickness=1e-4 * pitch)
    keys["lattice.wall_thickness"] = float(f"{2.0 * thin.thickest * draw.between(0.05, 0.4):.3g}")
    return case_of(keys)


def _memory(draw, keys):
    """Keys of a loss, of branches, of softening or of yielding; all with any step."""
    by_numbers = "material.modulus" in keys
    kind = draw.one("loss", "branches", "softening", "yielding" if by_numbers else "softening")
    steady = {"material.bend": "linear" if by_numbers else "section", "material.name": "ninjaflex"}
    found = {} if by_numbers else steady
    if kind == "yielding":
        modulus = keys["material.modulus"]
        return {
            "material.yield_stress": modulus * draw.between(1e-3, 0.3),
            "material.hardening": modulus * draw.one(0.0, draw.between(1e-4, 1.0)),
            "solver.bend_measure": "angle",
        }
    if kind == "branches":
        times = [draw.between(1e-9, 1e5) for _ in range(draw.whole(1, 6))]
        share = draw.between(0.01, 0.99) / len(times)
        found |= {
            "material.relaxation_times": tuple(times),
            "material.relaxation_shares": tuple(share for _ in times),
        }
    else:
        found |= {"material.loss": draw.between(0.02, 0.8)}
    if kind == "softening" and not by_numbers:
        found |= {"material.softening_r": draw.between(1.1, 10.0)}
        found |= {"material.softening_m": draw.between(1e2, 1e7), "solver.bend_measure": "angle"}
    if not by_numbers:
        found |= {"solver.bend_measure": "angle"}
    return found | {"material.reference_time": draw.between(1e-6, 1e4)}


def case_of(keys):
    """The case of these keys; a loading without speed has no damping."""
    if keys["loading.mode"] == "displacement" and "loading.speed" not in keys:
        keys = {key: value for key, value in keys.items() if not key.startswith("damping.")}
    return Case.of(**{name: _values(ALIKE | keys, name) for name in TABLES})


def _values(keys, name):
    """Values of a table by key; the material of a file by its place."""
    rows = [(key.split("."), value) for key, value in keys.items()]
    found = {key: value for (table, key), value in rows if table == name}
    if found.get("name", "").endswith(".csv"):
        found["name"] = str(CONFIGS / found["name"])
    return found


def _material(draw):
    """A material: foam to steel by numbers, a measured curve, or one with a plateau or
    softening.
    """
    plane = {"material.plane": draw.one("strain", "stress", "strain_bending")}
    if draw.chance(0.6):
        return plane | {
            "material.modulus": draw.between(1e3, 2e11),
            "material.density": draw.between(50.0, 8000.0),
            "material.poisson": draw.one(0.0, 0.3, 0.48, 0.4999),
        }
    made_up = "extreme/plateau.csv", "extreme/softening.csv"
    name = draw.one(*made_up) if draw.chance(0.3) else draw.one(*RECORDS)
    return plane | {"material.name": name, "material.bend": draw.one("linear", "section")}


def _lattice(draw):
    """1 x 1 to 30 x 30 cells, slender to stout, at most `MOST_NODES` nodes."""
    kind = "square" if draw.chance(0.5) else draw.one(*FAMILIES)
    cells_x, cells_y = draw.whole(1, 30), draw.whole(1, 30)
    pitch, aspect = draw.between(5e-4, 5e-2), draw.between(1 / 3, 3.0)
    keys = {
        "kind": kind,
        "cells_x": cells_x,
        "cells_y": cells_y,
        "width": float(f"{cells_x * pitch * aspect:.3g}"),
        "height": float(f"{cells_y * pitch:.3g}"),
        "depth": draw.between(1e-3, 0.1),
        "nodes_per_wall": draw.whole(0, 30),
        "grading": draw.between(0.3, 3.0) if draw.chance(0.1) else 1.0,
        "imperfection": 0.0 if draw.chance(0.5) else draw.between(1e-6, 1.0),
    }
    thin = lattice_with(**keys, wall_thickness=1e-4 * min(keys["width"] / cells_x, pitch))
    joints, walls = thin.counts
    if joints + walls * keys["nodes_per_wall"] > MOST_NODES:
        keys["nodes_per_wall"] = max(0, (MOST_NODES - joints) // walls)
    keys["wall_thickness"] = float(f"{2.0 * thin.thickest * draw.between(0.02, 0.45):.3g}")
    return {f"lattice.{key}": value for key, value in keys.items()}


def _contact(draw):
    model = "barrier" if draw.chance(0.95) else "none"
    if model != "barrier":
        return {"contact.model": model}
    return {
        "contact.model": model,
        "contact.friction": draw.one(0.0, 0.3, 1.0, 2.0),
        "contact.stiffness": draw.between(0.1, 10.0) if draw.chance(0.2) else 1.0,
    }


def _damping(draw):
    """None to overdamped."""
    model = draw.one("none", "rayleigh", "kelvin_voigt")
    return {
        "none": {"damping.model": model},
        "rayleigh": {
            "damping.model": model,
            "damping.mass": draw.one(0.0, draw.between(1e-2, 1e5)),
            "damping.stiffness": draw.one(0.0, draw.between(1e-8, 1.0)),
        },
        "kelvin_voigt": {
            "damping.model": model,
            "damping.relaxation_time": draw.between(1e-8, 10.0),
        },
    }[model]


def _solver(draw):
    return {
        "solver.element": "classical" if draw.chance(0.15) else "cubic",
        "solver.bend_measure": "tangent" if draw.chance(0.15) else "angle",
    }


def _loading(draw, keys):
    lattice = lattice_with(**_values(keys, "lattice"))
    material = material_with(**_values(keys, "material"))
    slenderness = lattice.wall_thickness / (lattice.height / lattice.cells_y)
    buckling = SWAY * slenderness**3 * material.modulus * lattice.width * lattice.depth
    mode = draw.one("slow", "fast", "force", "force", "impact", "slow")
    if mode == "force":
        return _force(draw, buckling)
    if mode == "impact":
        return _impact(draw, lattice, material, buckling)
    keys = {
        "loading.mode": "displacement",
        "loading.strain": draw.between(0.05, 0.97),
        "loading.platen": draw.one("glued", "contact"),
        "loading.unload": draw.chance(0.5),
        "solver.load_steps": draw.whole(5, 100),
    }
    if mode != "fast":
        return keys
    return keys | {
        "loading.speed": draw.between(1e-3, 300.0),
        "solver.integrator": "backward_euler",
    }


def _force(draw, buckling):
    """A thousandth to ten thousand times the load under which rows sway."""
    step, steps = draw.between(1e-8, 1.0), draw.whole(10, 80)
    return {
        "loading.mode": "force",
        "loading.force": float(f"{buckling * draw.between(1e-3, 1e4):.3g}"),
        "loading.platen": draw.one("none", "contact", "glued"),
        "loading.duration": float(f"{step * steps:.6g}"),
        "loading.release_time": float(f"{step * draw.whole(1, steps):.6g}"),
        "solver.time_step": step,
    }


def _impact(draw, lattice, material, buckling):
    """A striker of a hundredth to a thousand times the mass, long enough that it comes back."""
    own = mass(build_network(lattice.geometry), lattice.depth, material.density)
    striker, speed = own * draw.between(0.01, 1000.0), draw.between(0.1, 300.0)
    softest = np.pi * np.sqrt(striker * lattice.height / buckling)
    steps = draw.whole(200, 1000)
    duration = 4.0 * min(10.0 * lattice.height / speed, lattice.height / speed + softest)
    return {
        "loading.mode": "impact",
        "loading.striker_mass": float(f"{striker:.3g}"),
        "loading.striker_speed": speed,
        "loading.platen": draw.one("glued", "contact"),
        "loading.duration": float(f"{duration:.3g}"),
        "solver.integrator": draw.one("backward_euler", "bdf2"),
        "solver.time_step": float(f"{duration / steps:.3g}"),
    }


def toml(count):
    """The config of the first ``count`` scenes."""
    rows = [scene(number)[0] for number in range(count)]
    keys = sorted({key for row in rows for key in row})
    return HEAD + "".join(_axis(key, [row.get(key) for row in rows]) for key in keys)


def _axis(key, values):
    """One key with its values, ten a line; nothing where a scene does not use it."""
    words = [_word(key, value) for value in values]
    lines = [", ".join(words[k : k + 10]) for k in range(0, len(words), 10)]
    return f'"{key}" = [\n' + "".join(f"    {line},\n" for line in lines) + "]\n"


def _word(key, value):
    unit = case_keys()[key].unit
    if value is None:
        return '""'
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str) or unit is None or case_keys()[key].bare:
        return f'"{value}"' if isinstance(value, str) else repr(value)
    return f'"{value:.6g} {unit}"'


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(toml(COUNT), "utf-8")
