"""Random sweeps and random questions, with values at the borders of limits and within round-off."""

import numpy as np

from sweep.columns import absorbed_energy_column
from sweep.loading_modes import applies_to
from sweep.ranking.requirement_table import MEASURES
from sweep.ranking.requirements import limits
from tests.support.results.specimens import (
    HEIGHT,
    curve_of,
    squeezed_cell,
    summary,
    travelled,
    write,
)

FORCES = (20.0, 33.3333333333, 50.0)
PANELS = (None, None, (0.1, 0.05), (0.066, 0.012), (0.0333, 0.03))
BARS = ("absorbed_energy_until_packed_J", "peak_force_until_packed_N")
BARS += ("peak_strain", "peak_force_N", *map(absorbed_energy_column, FORCES))
FAR = (0.5, 0.9, 1.1, 1.5)
BORDER = (*FAR, *(1.0 + k * 1e-9 for k in (-3, -1.0001, -0.999, 0, 0.999, 1.0001, 3)))
"""Limits are values of designs times one of these: `ROUND_OFF` is 1e-9. What the page reads from
curves has fewer digits, and is never at the border.
"""
FELT = ("max_base_pressure", "max_target_acceleration")  # drawn apart from the others
BUDGETS = 4  # of a question, or none
SO_FAR = 9  # rows of the curve of a case that stopped
OTHERS = (
    {"platen": "contact"},
    {"loading_mode": "force", "force_N": 5.0},
    {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 1.5},
    {"loading_mode": "custom"},
)


def curve(factor):
    """A crush by 4 mm and up again, in which the force (N) rises from 10 to 90 times ``factor``, in
    two humps.
    """
    travel = travelled(15)
    force = 10.0 + 2e4 * travel + 30.0 * np.sin(travel / 4e-3 * 2.0 * np.pi)
    return curve_of(travel, factor * force)


def random_sweep(rng, other, count=16):
    """Designs in two scenes, a crush and one of `OTHERS`, and the factors of their curves.

    Values are equal, equal up to round-off, at the border of the model, or missing; some failed.
    """
    rows, factors = [], []
    masses, energies = rng.uniform(0.5, 4.0, 5), np.round(rng.uniform(0.01, 0.3, 5), 3)
    target = float(rng.spawn(1)[0].choice([np.nan, 200.0]))
    for scene in ({}, other):
        for _ in range(count):
            factor = float(rng.choice([1.0, rng.uniform(0.5, 1.5)]))
            rows.append(_row(rng, float(rng.choice(masses)), float(rng.choice(energies)), factor))
            rows[-1] |= scene
            factors.append(factor)
            if scene.get("loading_mode") == "impact":
                rows[-1]["impact_energy_J"] = 0.056
                rows[-1]["target_mass_g"] = target
    table = summary(*rows)
    for kind in ("error", "correction") if rng.random() < 0.7 else ():
        for name in BARS:
            bar = table[name] * rng.choice([1e-3, 0.05, 0.2], len(table))
            table[f"{kind}_{name}"] = bar.mask(rng.random(len(table)) < 0.1)
    return table, factors


def _row(rng, mass, energy, factor):
    """One design; its curve and its columns do not agree, which nothing here needs."""

    def near(value):
        return float(value * (1.0 + rng.choice([0.0, 0.0, 1e-10, -1e-10, 5e-10, 3e-9])))

    (apart,) = rng.spawn(1)
    whole = float(curve(factor)["work_in_J"].max())
    row = {
        "mass_g": round(mass, 9) + float(rng.choice([0.0, 5e-10, 1e-10, 0.3])),
        "height_m": HEIGHT,
        "outer_width_m": float(rng.choice([0.013, 0.02])),
        "sides": "free",
        "direction": "in_plane",
        "absorbed_energy_J": near(energy),
        "absorbed_energy_within_model_J": float(rng.choice([near(energy), whole, 0.5 * energy])),
        "peak_force_N": float(rng.choice([20.0, near(33.3333333333), rng.uniform(15.0, 80.0)])),
        "peak_force_until_packed_N": float(rng.choice([15.0, rng.uniform(10.0, 60.0)])),
        "peak_strain": float(rng.choice([0.5, near(0.5), rng.uniform(0.2, 1.1)])),
        "packing_strain": float(rng.choice([0.3, 0.4, np.nan])),
        "densification_strain": float(rng.choice([0.5, np.nan])),
        "peak_deceleration_filtered_m_per_s2": float(rng.choice([300.0, near(500.0), np.nan])),
        "peak_base_pressure_Pa": float(apart.choice([2e5, 3e5, np.nan])),
        "peak_target_acceleration_m_per_s2": float(apart.choice([200.0, 400.0, np.nan])),
        "peak_step_error": float(apart.choice([np.nan, 0.01, 0.6])),
        "stroke_left_m": float(rng.choice([1e-3, 0.0, -1e-10, -1e-8])),
        "returned_energy_J": 0.9 * energy,
        "max_crossings": int(rng.random() < 0.1),
        "status": "stopped" if rng.random() < 0.2 else "converged",
    }
    if rng.random() < 0.15:
        low, high = (float(rng.choice([0.8, 1.0]) * energy), float(rng.choice([1.0, 1.3]) * energy))
        row["lowest_absorbed_energy_at_densification_J"] = low
        row["highest_absorbed_energy_at_densification_J"] = high
    if row["status"] == "stopped":
        row["loaded"] = int(rng.random() < 0.3)
        row["status"] = "unresolved" if not row["loaded"] and rng.random() < 0.3 else "stopped"
        if not row["loaded"] and apart.random() < 0.2:
            row["status"] = "slipped"
    for force in FORCES:
        share = float(rng.choice([1.0, rng.uniform(0.2, 1.0), np.nan], p=[0.3, 0.6, 0.1]))
        row[absorbed_energy_column(force)] = share * row["absorbed_energy_J"]
    gaps = ("mass_g", "peak_force_N", "absorbed_energy_within_model_J", "absorbed_energy_J")
    return row | {name: np.nan for name in gaps if rng.random() < 0.03}


def write_curves(path, table, factors):
    """A results file with a row and a curve for each design."""

    def ran(row, number):
        history = {name: column.to_numpy() for name, column in curve(factors[number]).items()}
        rows = None if row["loaded"] else SO_FAR
        return {name: column[:rows] for name, column in history.items()}, squeezed_cell()

    return write(path, table, {"config": "{}"}, ran=ran)


def random_question(rng, table):
    """Budgets (kg), a panel, an allowed force (N), requirements in SI, and to what they apply."""
    panel = PANELS[rng.integers(len(PANELS))]
    per = "panel" if panel and rng.random() < 0.4 else "specimen"
    count = 1.0 if panel is None else float(rng.choice([1.0, 5.0, 28.0, 35.0]))
    force = [None, None, *FORCES, 27.0, 41.5][rng.integers(7)]
    force = None if force is None else force * (count if per == "panel" else 1.0)
    modes = {*table["loading_mode"]}
    known = [name for name in MEASURES if modes.intersection(applies_to(name))]
    (apart,) = rng.spawn(1)
    draws = {name: apart if name in FELT else rng for name in known}
    names = [name for name in known if draws[name].random() < 0.25]
    shared = count if per == "panel" else 1.0
    steps = FAR if read_from_curves({"force": force, "per": per}) else BORDER
    require = {
        name: _limit(draws[name], table, name, steps) * (shared if MEASURES[name].shared else 1.0)
        for name in names
    }
    limited = BUDGETS if rng.random() < 0.75 else 0
    masses = [_limit(rng, table, "max_mass") * count for _ in range(limited)]
    return {
        "budgets": [*dict.fromkeys(masses)],
        "panel": panel,
        "force": force,
        "per": per,
        "require": require,
    }


def each_budget(question):
    """The question within each of its budgets (kg), or the one without a budget."""
    return [question | {"budget": budget} for budget in question["budgets"] or [None]]


def _limit(rng, table, name, steps=BORDER):
    """A limit (SI) at or near the value of a design."""
    strokes = table["packing_strain"] * table["height_m"]
    values = {
        "max_force": table["peak_force_N"],
        "max_deceleration": table["peak_deceleration_filtered_m_per_s2"],
        "max_base_pressure": table["peak_base_pressure_Pa"],
        "max_target_acceleration": table["peak_target_acceleration_m_per_s2"],
        "max_mass": 1e-3 * table["mass_g"],
        "min_absorbed": table["absorbed_energy_J"],
        "max_stroke": strokes,
    }[name].dropna()
    value = float(rng.choice(values)) * float(rng.choice(steps))
    return limits({name: value})[name]


def read_from_curves(question):
    """Whether the page reads energies from curves, as no column has them."""
    force = question["force"]
    return force is not None and (question["per"] == "panel" or force not in FORCES)
