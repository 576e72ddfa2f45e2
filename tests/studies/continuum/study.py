"""The comparison itself: grids of slender to stout walls, and a crush until they are packed.

The solids are read from solids.csv.
"""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.studies.continuum.network import Network
from tests.studies.continuum.solids import PACKED, Crush

FILE = Path(__file__).with_name("solids.csv")
APART = (0.05, 0.1, 0.2, 0.3)  # strains, the last one cut to the strain of the solid
WATCHED = (0.1, 0.3, 0.4, 0.5, 0.6)  # of the crush with contact of walls
POINTS = "points, linear", 3, {"joints": "points", "bend": "linear"}
MODELS = (
    POINTS,
    ("solid joints, linear", 3, {"bend": "linear"}),
    ("default", 2, {}),
    ("default", 3, {}),
    ("default", 6, {}),
)
CONTACT = POINTS, *(("default", pieces, {}) for pieces in (2, 3, 6, 12))


@dataclass(frozen=True)
class Side:
    """A name, and (strain, force in N, energy in mJ) of a crush."""

    name: str
    rows: np.ndarray

    def at(self, strains):
        """Force and energy, one after the other."""
        strain, force, energy = self.rows
        return np.concatenate(
            [np.interp(strains, strain, force), np.interp(strains, strain, energy)]
        )


@dataclass(frozen=True)
class Compared:
    """Crushes of one grid. truth: of the finest solid. sides: others."""

    case: Crush
    strains: tuple
    truth: Side
    sides: list

    def values(self):
        """Forces in N and energies in mJ of the finest solid."""
        return self.truth.at(self.strains)

    def errors(self):
        """Name and errors in % of the others."""
        for side in self.sides:
            yield side.name, 100.0 * (side.at(self.strains) / self.values() - 1.0)


def stored():
    """The solids of the file, (3, k) by (t / L, plane, elements through a wall)."""
    with FILE.open(encoding="utf-8") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    curves = {}
    for line in lines:
        key = float(line["t_over_l"]), line["plane"], int(line["across"])
        row = [float(line[name]) for name in ("strain", "force_N", "energy_mJ")]
        curves.setdefault(key, []).append(row)
    return {key: np.array(rows).T for key, rows in curves.items()}


def networks(case, models, contact):
    """The network of a solid by several models."""
    for name, pieces, model in models:
        network = Network(case.grid(), case.rubber(), pieces, contact, case.plane, **model)
        yield Side(f"{name}, {pieces} elements", np.array(network.crush(case.strain)))


def compared(coarse, fine, models=MODELS, watched=APART, contact="none"):
    """Networks and a solid of two meshes."""
    coarser, truth = (
        Side(f"solid, {case.across} elements across", stored()[case[:3]]) for case in (coarse, fine)
    )
    strains = tuple(min(strain, fine.strain) for strain in watched)
    return Compared(fine, strains, truth, [*networks(fine, models, contact), coarser])


def packed():
    """The crush with contact of walls."""
    return compared(*PACKED, CONTACT, WATCHED, "barrier")
