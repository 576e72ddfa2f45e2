"""Summaries made by hand, for tests of what reads them."""

from itertools import count

import pandas as pd

from sweep.result import COLUMNS

_DEFAULTS = {
    "status": "converged",
    "message": "",
    "lattice_kind": "square",
    "cells_x": 3,
    "cells_y": 3,
    "wall_thickness_m": 0.8e-3,
    "width_m": 12.2e-3,
    "height_m": 12.2e-3,
    "depth_m": 10e-3,
    "material": "ninjaflex",
    "loading_mode": "displacement",
    "platen": "glued",
    "force_N": float("nan"),
    "stroke_m": 6.1e-3,
    "contact_model": "barrier",
    "mass_g": 1.0,
    "absorbed_energy_J": 0.05,
    "peak_force_N": 20.0,
    "densification_strain": 0.55,
    "max_crossings": 0,
    "cpu_s": 2.0,
}


def summary(*rows):
    """Table with a row for each dict of what differs from a 3 x 3 grid crushed to one half.

    Ids count from 0...0; J/g follows from energy and mass; columns not named are 0.
    """
    ids = count()
    full = [{"case_id": f"{next(ids):016x}"} | _DEFAULTS | dict(row) for row in rows]
    for row in full:
        row["specific_absorption_J_per_g"] = row["absorbed_energy_J"] / row["mass_g"]
    names = dict.fromkeys([*COLUMNS, *(name for row in full for name in row)])
    return pd.DataFrame({name: [row.get(name, 0.0) for row in full] for name in names})


def designs(masses, energies, **common):
    """Rows with these masses (g) and absorbed energies (J)."""
    pairs = zip(masses, energies, strict=True)
    return [{"mass_g": mass, "absorbed_energy_J": energy} | common for mass, energy in pairs]
