"""Whether an impact or a dead load that could not be followed has closed all voids of its lattice.

A lattice that is as low as a solid of its mass and width bottoms out: its walls bear only by being
pressed against each other, which is beyond the model, and often takes steps a thousandth as long.
A run that ends there with a failure has an answer nevertheless: the design bears too little. The
integrator may have removed energy until then, which makes a striker stop earlier, never later.

A load at rest is beyond all lattices of the same mass, too, if it would press a column of that
mass, which is the stiffest of them (W. Voigt, Lehrbuch der Kristallphysik, 1910), until it is as
low.
"""

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.numbers import percent, short
from sweep.result import Result
from sweep.scene.beams import plane_factors
from sweep.scene.material import stress_law
from sweep.simulation.striker import closing_speed

ADVICE = "the lattice bottoms out, and what follows is beyond the model"


def bottoms_out(result: Result) -> str:
    """How a failed case has closed all voids of its lattice, in words; empty if it has not."""
    match result.case.loading:
        case Impact():
            why = _struck(result)
        case DeadLoad() if not isinstance(result.case.lattice, CustomStructure):
            filled = float(result.summary["relative_density"])
            has_voids = 0.0 < filled < 1.0
            why = _pressed(result, filled) or _overloaded(result.case, filled) if has_voids else ""
        case _:
            why = ""
    return f"{why}: {ADVICE}" if why else ""


def _struck(result: Result) -> str:
    if result.summary["bottomed_out"] != 1.0:
        return ""
    loading, history = result.case.loading, result.history
    assert isinstance(loading, Impact)
    depth = history["top_displacement_m"]
    voids = float(depth.max() + result.summary["stroke_left_m"])
    row = int(np.argmax(depth >= voids))
    left = 0.5 * loading.reduced_mass * float(closing_speed(history)[row]) ** 2
    share = percent(left / loading.relative_energy)
    at = f"at strain {result.history['strain'][row]:.3g}"
    return f"the striker has closed all voids, {at}, with {share} % of its energy left"


def _pressed(result: Result, filled: float) -> str:
    """filled: volume as drawn / volume of the outer box."""
    strain = float(result.summary["peak_strain"])
    return f"the load has closed all voids (strain {strain:.3g})" if strain >= 1.0 - filled else ""


def _overloaded(case: Case, filled: float) -> str:
    loading = case.loading
    assert isinstance(loading, DeadLoad)
    if case.shells:
        return ""
    stress = -float(stress_law(case.material).at(np.array([filled - 1.0]))[0])
    section = filled * case.lattice.outer_size[0] * case.lattice.depth
    ratio = loading.force / (plane_factors(case.material)[0] * stress * section)
    if ratio < 1.0:
        return ""
    column = "presses a column of the mass of the lattice until it is as low as without voids"
    return f"the load is {short(ratio)} times that which {column}"
