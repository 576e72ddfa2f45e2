"""The loss of a lattice in one cycle, against the loss of its material; and its rate."""

from itertools import product

import numpy as np

from sweep.config.case import Case
from sweep.numbers import tenths
from sweep.report.tables.sheet import Sheet
from tests.studies.rankings.spread import CELLS
from tests.support.designs.tables import lattice_with

PATTERNS = ("square", "hex", "circle", "triangle", "kagome")
LOSSES = (None, 0.2, 0.4)
SCENES = tuple(product(("glued", "contact"), (0.0, 0.3)))  # platens, friction
LOOSE = {"glued": "glued", "contact": "loose"}
DEEP, SHALLOW = 0.6, 0.02  # strain
RATES = (1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0)  # 1/s
BOX = {"width": 20e-3, "height": 20e-3, "mass": 1.2e-3}


def cycle(pattern, platen, friction, loss, strain=DEEP):
    """One cycle of a lattice, quasi-static."""
    cells = CELLS[pattern]
    return Case.of(
        lattice=dict(kind=pattern, cells_x=cells, cells_y=cells, **BOX),
        material=dict(loss=loss),
        loading=dict(mode="displacement", strain=strain, platen=platen),
        contact=dict(friction=friction),
        solver=dict(load_steps=200),
    )


def cycles():
    """The cycles of all patterns, (pattern, platen, friction, loss, strain) -> case."""
    keys = product(PATTERNS, SCENES, LOSSES, (DEEP, SHALLOW))
    flat = [(pattern, *scene, loss, strain) for pattern, scene, loss, strain in keys]
    return {key: cycle(*key) for key in flat}


def losses(rows):
    """Lost shares of all cycles. rows: summary by key of `cycles`."""
    heads = ["pattern", "platens", "friction"]
    for strain, loss in product((SHALLOW, DEEP), LOSSES):
        heads.append(f"{100 * strain:g} %: {'elastic' if loss is None else tenths(loss)}")
    table = []
    for pattern, (platen, friction) in product(PATTERNS, SCENES):
        shares = []
        for strain, loss in product((SHALLOW, DEEP), LOSSES):
            row = rows[pattern, platen, friction, loss, strain]
            shares.append(tenths(1.0 - row["returned_energy_J"] / row["absorbed_energy_J"]))
        table.append([pattern, LOOSE[platen], f"{friction:g}", *shares])
    notes = (
        "Share of the work of a crush to 2 and 60 % that is not given back, in %. Heads: loss of",
        "the material, that of a strip which is stretched and released evenly.",
    )
    return Sheet("Loss of a lattice and of its material", heads, table, notes=notes)


def rated():
    """Crushes of one lattice at all rates: (rate, moving) -> case; moving: with inertia."""
    found = {}
    for rate, moving in product(RATES, (False, True)):
        lattice = lattice_with()
        pace = {"speed": rate * lattice.height} if moving else {"strain_rate": rate}
        found[rate, moving] = Case.of(
            lattice=lattice,
            material=dict(loss=0.4),
            loading=dict(mode="displacement", strain=DEEP, quasi_static=not moving, **pace),
            damping={},
            solver=dict(load_steps=200) | ({"integrator": "backward_euler"} if moving else {}),
        )
    return found


def rates(rows):
    """Energy, force and loss at all rates. rows: summary by key of `rated`."""
    heads = ["rate, 1/s", "energy, mJ", "plateau, kPa", "lost, %", "over 1e-2", "moving", "lost, %"]
    still = {rate: rows[rate, False] for rate in RATES}
    base, table = still[1e-2]["absorbed_energy_J"], []
    for rate in RATES:
        row, moved = still[rate], rows[rate, True]
        table.append(
            [
                f"{rate:g}",
                f"{1e3 * row['absorbed_energy_J']:.1f}",
                f"{1e-3 * row['plateau_stress_iso_Pa']:.1f}",
                tenths(1.0 - row["returned_energy_J"] / row["absorbed_energy_J"]),
                f"{row['absorbed_energy_J'] / base:.2f}",
                f"{1e3 * moved['absorbed_energy_J']:.1f}",
                tenths(1.0 - moved["returned_energy_J"] / moved["absorbed_energy_J"]),
            ]
        )
    energies = np.log([still[rate]["absorbed_energy_J"] for rate in RATES])
    power = np.polyfit(np.log(RATES), energies, 1)[0]
    notes = (
        "3 x 3 cells of ninjaflex with a loss of 40 %, crushed to 60 % and released; the last two",
        f"columns with inertia. Energy grows with the power {power:.3f} of the rate.",
    )
    return Sheet("Rate of a crush", heads, table, notes=notes)
