"""Energy-absorption diagram and cushion curve of a design, from the curve of its crush.

Energy-absorption diagram (Maiti, Gibson & Ashby 1984): energy per volume W(e) over the greatest
stress so far M(e), both divided by the modulus of the solid. Its shoulder is where W / M is
greatest: the most energy for the transmitted stress.

Cushion curve (drawn from drops in ASTM D1596): greatest deceleration G, in units of gravity g, over
the static stress p = m g / A of a weight m that falls from a height H onto a cushion of area A and
thickness T. It is estimated from a slow crush, without rate effects and without losses: the weight
stops at the strain e at which the cushion has taken all of its energy,

    T W(e) = p (H + e T),    G = M(e) / p.

A falling striker of the sweep has its weight too, and G is the force on it / (m g).
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from pandas import DataFrame, Series

from sweep.array_types import Floats
from sweep.constants import STANDARD_GRAVITY
from sweep.numbers import to_si

SLACK = 1e-6  # histories are stored with single precision
SAME_HEIGHT = 0.02  # drops from heights that differ by less are drawn as one


class Crush(NamedTuple):
    """The first loading of a crush as far as the model is valid, in rows in which it absorbs
    energy.

    strain (rows,); greatest: greatest nominal stress so far (rows,) Pa; work: energy per volume
    (rows,) J/m^3; thickness: height at rest, m.
    """

    strain: Floats
    greatest: Floats
    work: Floats
    thickness: float


def crush_of(history: DataFrame, row: Mapping[Any, Any]) -> Crush:
    """The crush with this history and this row of the summary, until a wall breaks or an element is
    too short for the model.
    """
    area, height = row["outer_width_m"] * row["depth_m"], row["height_m"]
    strain = history["strain"].to_numpy()
    end = int(np.argmax(strain >= strain.max() * (1.0 - SLACK))) + 1 if len(strain) else 0
    greatest = np.maximum.accumulate(history["reaction_top_N"].to_numpy()[:end]) / area
    work = history["work_in_J"].to_numpy()[:end] / (area * height)
    within = row["absorbed_energy_within_model_J"] / (area * height)
    kept = (work > 0.0) & (greatest > 0.0) & (work <= within * (1.0 + SLACK))
    return Crush(strain[:end][kept], greatest[kept], work[kept], float(height))


def shoulder(crush: Crush) -> int | None:
    """The row of greatest energy / stress; None if it is the last one, as both may rise."""
    if not len(crush.work):
        return None
    best = int(np.argmax(crush.work / crush.greatest))
    return best if best < len(crush.work) - 1 else None


def absorbed_below(crush: Crush, stresses: Floats) -> Floats:
    """Energy per volume (n,) that is absorbed until the stress exceeds each of ``stresses`` (n,),
    Pa.

    NaN below the first row; beyond the greatest stress all absorbed energy, which is a lower bound.
    """
    if not len(crush.work):
        return np.full(len(stresses), np.nan)
    row = np.searchsorted(crush.greatest, stresses, side="right") - 1
    following = np.minimum(row + 1, len(crush.work) - 1)
    rise = crush.greatest[following] - crush.greatest[row]
    share = np.divide(stresses - crush.greatest[row], rise, np.zeros(len(row)), where=rise > 0.0)
    energy = crush.work[row] + share * (crush.work[following] - crush.work[row])
    return np.where(row >= 0, energy, np.nan)


def cushion_curve(crush: Crush, drop_height: float) -> tuple[Floats, Floats]:
    """Static stress (Pa) and greatest deceleration (in units of gravity) of drops, (n,) each.

    drop_height: m. Strains that a lighter weight has passed are left out.
    """
    static = crush.thickness * crush.work / (drop_height + crush.strain * crush.thickness)
    before = np.append(0.0, np.maximum.accumulate(static)[:-1])
    new = static > before
    return static[new], crush.greatest[new] / static[new]


def drops(impacts: DataFrame) -> DataFrame:
    """Drop height (m), static stress (Pa) and filtered deceleration (in units of gravity) of the
    impacts with gravity; NaN where the filter has too few rows.
    """
    falls = impacts[impacts["gravity"] == 1.0]
    area = falls["outer_width_m"] * falls["depth_m"]
    return falls.assign(
        drop_height_m=falls["striker_speed_m_per_s"] ** 2 / (2.0 * STANDARD_GRAVITY),
        static_stress_Pa=to_si(falls["striker_mass_g"], "g") * STANDARD_GRAVITY / area,
        peak_G=falls["peak_deceleration_filtered_m_per_s2"] / STANDARD_GRAVITY,
    )


def dropped_from(falls: DataFrame, drop_height: float) -> Series:
    """True for the rows of `drops` from a height (m), or nearly so."""
    return (falls["drop_height_m"] / drop_height - 1.0).abs() <= SAME_HEIGHT
