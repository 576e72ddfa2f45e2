"""The spread of the best designs: each simulated again at both ends of every uncertain number.

The uncertain numbers are those for which the file of a material states a range
(`config.material_header`), unless the config gives them itself; the branch of its curve that is
derived from the other one, by two rules; and the friction. One number at a time is at an end of its
range; the shape of the specimen stays the same. A modulus scales the whole curve. A lattice pressed
along its cells is also simulated with other imperfections, as there are many ways to fold.

These corners are ordinary cases, in a results file of their own beside the results of the sweep, so
that they are no designs of its ranking: `armor.spread.h5` beside `armor.h5`.
"""

import os
from collections.abc import Iterable, Mapping
from typing import Any

from sweep.config.case import Case
from sweep.config.kinds.contact import Barrier
from sweep.config.kinds.material import Material
from sweep.coupon.curve import with_tension
from sweep.running.beside.run_beside import How, file_beside, run_beside
from sweep.scene.material import with_compression
from sweep.store.read import read_case

FRICTION = 0.2, 0.9  # of TPU on TPU or steel, assumed: no source (configs/materials/README.md)
BRANCHES = {"compression": with_compression, "tension": with_tension}
BEST = 5  # designs of a ranking
SEEDS = 1, 2, 3  # seeds of other imperfections of a lattice that is pressed along its cells


Corners = Mapping[str, Case]
"""Cases with a number at an end of its range, by their names, such as "friction 0.9"."""


def corners(design: Case) -> dict[str, Case]:
    """The corners of a design that differ from it. A friction that the sweep varies is not
    changed.
    """
    ranges = {name: (low, high) for name, low, high in design.material.uncertain}
    if design.material.plane == "stress":
        ranges.pop("poisson", None)
    friction = ranges.pop("friction", FRICTION)
    if isinstance(design.contact, Barrier) and "contact.friction" not in design.axes:
        ranges["friction"] = friction
    candidates = {
        f"{name} {end}": _with_value(design, name, value)
        for name, ends in ranges.items()
        for end, value in _named(name, ends)
    }
    if design.shells and design.lattice.imperfection > 0.0:
        candidates |= {f"imperfection {seed}": _bowed(design, seed) for seed in SEEDS}
    return {name: case for name, case in candidates.items() if case.case_id != design.case_id}


def _bowed(design: Case, seed: int) -> Case:
    """The design with an imperfection drawn by a seed."""
    labels = {"lattice.imperfection_seed": seed}
    return design.changed(labels, lattice={"imperfection_seed": seed, "mass": None})


def _named(name: str, ends: tuple[float, float]) -> Iterable[tuple[str, float]]:
    """Both ends of a range with their names: friction by its value, as it is the same for all
    materials.
    """
    words = [f"{value:g}" for value in ends] if name == "friction" else ["low", "high"]
    return zip(words, ends, strict=True)


def _with_value(design: Case, name: str, value: float) -> Case:
    """The design with another value of an uncertain number, and a label for it."""
    if name == "friction":
        return design.changed({"contact.friction": value}, contact={"friction": value})
    walls = {"mass": None}  # they stay
    labels, change = {f"material.{name}": value}, _other(design.material, name, value)
    return design.changed(labels, lattice=walls, material=change)


def _other(material: Material, name: str, value: float) -> dict[str, Any]:
    """The changes of a material with another value of a number, or of the share of a rule."""
    if name in BRANCHES:
        strain, stress = BRANCHES[name](material.curve_strain, material.curve_stress, value)
        curve = {"curve_strain": strain, "curve_stress": stress}
        return {key: tuple(values.tolist()) for key, values in curve.items()}
    change: dict[str, Any] = {name: value}
    if name == "modulus":
        scale = value / material.modulus
        change["curve_stress"] = tuple(scale * stress for stress in material.curve_stress)
    return change


def corners_of(
    cases: Iterable[Case], best: Iterable[str], out: str | os.PathLike[str]
) -> dict[str, Corners]:
    """The corners of the `best` cases by their ids: cases of the sweep, which have its present
    labels and time limit, and others as `out` holds them.
    """
    by_id = {case.case_id: case for case in cases}
    return {case_id: corners(by_id.get(case_id) or read_case(out, case_id)) for case_id in best}


def run_corners(
    by_design: Mapping[str, Corners],
    out: str | os.PathLike[str],
    how: How,
) -> None:
    """Run the missing corners of designs in `out`."""
    others = {case.case_id: case for group in by_design.values() for case in group.values()}
    what = f"spread of {len(by_design)} designs: {len(others)} cases"
    run_beside(others, file_beside(out, "spread"), what, how)
