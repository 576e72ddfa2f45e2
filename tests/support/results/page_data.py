"""Invented sweeps for tests of the page."""

import numpy as np

from tests.support.results.specimens import summary

FORCES = (20.0, 50.0)
BARS = ("absorbed_energy_until_packed_J", "peak_force_until_packed_N")
BARS += ("peak_strain", "peak_force_N")
BARS += tuple(f"absorbed_energy_at_{force:g}N_J" for force in FORCES)


def sweep(count=24, seed=1, bars=True, more=None):
    """Designs of random mass and energy: crushed, below a dead load, struck by a striker.

    Some have equal values, some no value, some walls that cross.
    """
    rng = np.random.default_rng(seed)
    rows = []
    for k in range(count):
        mass, energy = float(rng.choice([1.0, 1.5, rng.uniform(0.5, 4.0)])), rng.uniform(0.01, 2.0)
        energy = float(np.round(energy, 1) if k % 3 else energy)
        row = {
            "mass_g": mass,
            "wall_thickness_m": 1e-4 * (k % 7 + 4),
            "cells_x": k % 4 + 2,
            "direction": "out_of_plane" if k % 6 == 1 else "in_plane",
            "outer_width_m": 0.013 if k % 2 else 0.02,
            "absorbed_energy_J": energy,
            "absorbed_energy_within_model_J": energy * (0.4 if k % 5 == 0 else 1.0),
            "peak_force_N": float(rng.uniform(15.0, 80.0)),
            "peak_strain": 0.5,
            "packing_strain": 0.3 + 0.02 * (k % 9),
            "peak_deceleration_filtered_m_per_s2": 100.0 * (k % 6) if k % 6 else np.nan,
            "returned_energy_J": 0.9 * energy,
            "max_crossings": int(k % 11 == 0),
        }
        for force in FORCES:
            share = float(rng.uniform(0.2, 1.0))
            row[f"absorbed_energy_at_{force:g}N_J"] = np.nan if k % 8 == 7 else share * energy
        rows.append(row)
    load = [row | {"loading_mode": "force", "force_N": 5.0} for row in rows[::2]]
    for k, row in enumerate(load):
        row["peak_strain"] = float(rng.uniform(0.01, 1.1)) if k % 4 else 0.3
    blow = {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 1.5}
    table = summary(*rows, *load, *[row | blow | {"impact_energy_J": 0.056} for row in rows[1::2]])
    for kind in ("error", "correction") if bars else ():
        for name in BARS:
            table[f"{kind}_{name}"] = table[name] * rng.choice([0.001, 0.05, 0.2], len(table))
            table.loc[rng.random(len(table)) < 0.1, f"{kind}_{name}"] = np.nan
    return table.assign(**(more or {}))
