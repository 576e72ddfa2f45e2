"""Whether an impact or a dead load that could not be followed is beyond its lattice.

A lattice that is as low as a solid of its mass and width bottoms out: its walls bear only by being
pressed against each other, which is beyond the model, and often takes steps a thousandth as long.
A run that fails there has an answer nevertheless, if nothing in it is close:

- A flat striker closed all voids while it had at least half of its energy left, and of the work of
  its weight until then: the lattice would have to absorb twice what it has absorbed, or more.
- The load would press a solid column of the mass of the lattice, the stiffest of all shapes (W.
  Voigt, Lehrbuch der Kristallphysik, 1910), until it is as low as the lattice without voids, and
  acts for several times as long as a free fall through the height takes. Without platens the top
  may also swing below its base, and hang there.
"""

from math import sqrt

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.numbers import percent, short, to_si
from sweep.result import Result
from sweep.scene.beams import plane_factors
from sweep.scene.material import stress_law
from sweep.simulation.striker import closing_speed

LEFT = 0.5  # least share of the energy of a striker where it closes all voids
FALLS = 4.0  # least time of a dead load, in free falls under it through the height of the lattice
ENDS = "the lattice {}, and what follows is beyond the model"
CLOSED, FREE = "bottoms out", "bottoms out or swings below its base"


def bottoms_out(result: Result) -> str:
    """Why the lattice of a failed case bottoms out, in words; empty if that is not certain."""
    case, ends = result.case, CLOSED
    match case.loading:
        case Impact(striker="flat"):
            why = _struck(result)
        case DeadLoad(platen=platen) if not case.shells:
            ends = FREE if platen == "none" else CLOSED
            filled, grams = (float(result.summary[n]) for n in ("relative_density", "mass_g"))
            why = _pressed(case, filled, to_si(grams, "g"))
        case _:
            why = ""
    return f"{why}: {ENDS.format(ends)}" if why else ""


def _struck(result: Result) -> str:
    if result.summary["bottomed_out"] != 1.0:
        return ""
    loading, depth = result.case.loading, result.history["top_displacement_m"]
    assert isinstance(loading, Impact)
    energy = 0.5 * loading.reduced_mass * closing_speed(result.history) ** 2
    stroke = float(result.summary["peak_strain"]) * result.case.height
    voids = stroke + float(result.summary["stroke_left_m"])
    if not 0.0 < voids <= depth.max():  # a solid, or closed between two rows: it turns there
        return ""
    row = int(np.argmax(depth >= voids))
    left = float(np.interp(voids, depth[row - 1 : row + 1], energy[row - 1 : row + 1]))
    share = left / (loading.relative_energy + loading.weight * voids)
    if share < LEFT:
        return ""
    return f"the striker closes all voids with {percent(share)} % of its energy left"


def _pressed(case: Case, filled: float, mass: float) -> str:
    """filled: volume as drawn / volume of the outer box. mass: kg."""
    loading = case.loading
    assert isinstance(loading, DeadLoad)
    if isinstance(case.lattice, CustomStructure) or not 0.0 < filled < 1.0:
        return ""
    fall = sqrt(2.0 * mass * case.height / loading.force)
    if loading.release_time < FALLS * fall:
        return ""
    stress = -float(stress_law(case.material).at(np.array([filled - 1.0]))[0])
    section = filled * case.lattice.outer_size[0] * case.lattice.depth
    ratio = loading.force / (plane_factors(case.material)[0] * stress * section)
    if ratio < 1.0:
        return ""
    column = "a solid column of its mass bears before it is as low as the lattice without voids"
    return f"the load is {short(ratio)} times what {column}"
