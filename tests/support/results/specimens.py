"""Results made by hand, for tests of their readers."""

from dataclasses import dataclass
from itertools import count

import numpy as np
import pandas as pd

from sweep.columns import COLUMNS, HISTORY_COLUMNS
from sweep.result import MODEL_VERSION, Result, Status
from sweep.store.write import Writer

HEIGHT, T = 10e-3, 1e-3  # of the squeezed cell

_DEFAULTS = {
    "status": "converged",
    "message": "",
    "retry": "",
    "lattice_kind": "square",
    "cells_x": 3,
    "cells_y": 3,
    "wall_thickness_m": 0.8e-3,
    "sides": "free",
    "direction": "in_plane",
    "width_m": 12.2e-3,
    "height_m": 12.2e-3,
    "depth_m": 10e-3,
    "outer_width_m": 13e-3,
    "material": "ninjaflex",
    "material_modulus_Pa": 12e6,
    "material_memory": "none",
    "loading_mode": "displacement",
    "platen": "glued",
    "striker": "flat",
    "base": "flat",
    "force_N": float("nan"),
    "stroke_m": 6.1e-3,
    "target_mass_g": float("nan"),
    "contact_model": "barrier",
    "mass_g": 1.0,
    "absorbed_energy_J": 0.05,
    "peak_force_N": 20.0,
    "densification_strain": 0.55,
    "packing_strain": 0.54,
    "packing_span": 0.02,
    "second_cycle_share": float("nan"),
    "solid_joint_share": 1.0,
    "printed_mass_g": float("nan"),
    "infill_share": float("nan"),
    "slicer_settings": "",
    "does_not_print": "",
    "solid_strain": float("nan"),
    "touched": 1,
    "max_crossings": 0,
    "cpu_s": 2.0,
    "model_version": MODEL_VERSION,
}


CRUSHED_SOLID = {
    "absorbed_energy_J": 0.9,
    "absorbed_energy_until_packed_J": 0.2,
    "absorbed_energy_within_model_J": 0.5,
    "peak_force_N": 900.0,
    "peak_force_until_packed_N": 30.0,
    "returned_energy_J": 0.81,
}
SPARSE = {"absorbed_energy_J": 0.3, "returned_energy_J": 0.285, "densification_strain": np.nan}
SPARSE |= {"peak_strain": 0.5, "peak_force_N": 25.0}


def summary(*rows):
    """Table with a row for each dict of differences from a 3 x 3 grid crushed to one half.

    Ids count from 0...0; J/g follows from energy and mass; energies until densification and
    within the model equal the values of the whole crush; columns not named are 0.
    """
    ids = count()
    full = [{"case_id": f"{next(ids):016x}"} | _DEFAULTS | dict(row) for row in rows]
    for row in full:
        row.setdefault("loaded", int(row["status"] == "converged"))
        row["specific_absorption_J_per_g"] = row["absorbed_energy_J"] / row["mass_g"]
        for point in ("at_densification", "until_packed", "within_model"):
            row.setdefault(f"absorbed_energy_{point}_J", row["absorbed_energy_J"])
        for point in ("at_densification", "until_packed"):
            row.setdefault(f"peak_force_{point}_N", row["peak_force_N"])
    names = dict.fromkeys([*COLUMNS, *(name for row in full for name in row)])
    return pd.DataFrame({name: [row.get(name, 0.0) for row in full] for name in names})


def designs(masses, energies, **common):
    """Rows with these masses (g) and absorbed energies (J)."""
    pairs = zip(masses, energies, strict=True)
    return [{"mass_g": mass, "absorbed_energy_J": energy} | common for mass, energy in pairs]


CRUSHES = summary(*designs([1.0, 2.0, 3.0], [0.10, 0.18, 0.40], height_m=12.5e-3)).assign(
    peak_force_until_packed_N=[20.0, 30.0, 80.0]
)
"""Three crushes: the heavier, the more energy and force."""
HIT = {"loading_mode": "impact", "stroke_m": np.nan, "striker_mass_g": 50.0, "height_m": 12.5e-3}
HIT |= {"impact_energy_J": 1.5, "peak_strain": 0.5, "indentation_m": 6e-3, "stroke_left_m": 4e-3}
IMPACTS = summary(*(HIT | {"peak_force_N": force} for force in (76.0, 90.0))).assign(
    peak_deceleration_filtered_m_per_s2=[500.0, np.nan]
)
"""Two impacts, the second without a filtered deceleration."""


def travelled(rows):
    """A way (2 rows - 1,) down by 4 mm and back, m."""
    return 4e-3 * np.concatenate([np.linspace(0, 1, rows), np.linspace(1, 0, rows)[1:]])


def curve_of(travel, force):
    """History of a block of 10 mm that is pressed along a way (m) with a force (N)."""
    work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(travel)))
    history = pd.DataFrame(0.0, index=range(len(travel)), columns=list(HISTORY_COLUMNS))
    history["top_displacement_m"], history["strain"] = travel, travel / HEIGHT
    history["reaction_top_N"] = history["reaction_bottom_N"] = force
    history["work_in_J"], history["time_s"] = work, np.arange(len(travel)) * 1e-3
    return history


def there_and_back(rows=21):
    """A block pressed at a rising force and let up at half of it."""
    travel = travelled(rows)
    force = 20.0 + 2e3 * travel
    force[rows:] *= 0.5
    history = curve_of(travel, force)
    work = history["work_in_J"]
    history["bend_J"], history["dissipated_friction_J"] = 0.7 * work, 0.3 * work
    history["kinetic_J"] = 1e-4 * work
    return history


def under_dead_load():
    """A block that sinks to 4 mm under 20 N while they are on, and rises when they are off."""
    history = there_and_back()
    loaded = np.arange(len(history)) <= history["strain"].idxmax()
    history["reaction_top_N"] = np.where(loaded & (history["time_s"] > 0.0), 20.0, 0.0)
    history["reaction_bottom_N"] = history["reaction_top_N"]
    history["work_in_J"] = 20.0 * history["top_displacement_m"].cummax()
    return history


def squeezed_cell(platens=True, heights=(10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 7.0, 10.0)):
    """A single cell, 10 mm square with walls of 1 mm, squeezed flat and let up."""
    position = np.array([[[0, 0], [10, 0], [10, h], [0, h]] for h in heights]) * 1e-3
    top = np.array(heights) * 1e-3
    plates = np.column_stack([np.full(len(top), -0.5 * T), top + 0.5 * T])
    return {
        "strain": 1.0 - top / HEIGHT,
        "time_s": np.arange(len(top)) * 0.01,
        "position_m": position,
        "edges": np.array([[0, 1], [1, 2], [2, 3], [3, 0]]),
        "edge_thickness_m": np.full(4, T),
        "plate_y_m": plates if platens else np.full_like(plates, np.nan),
    }


def tube(frames=3):
    """An upright square tube of four quads, 1 x 1 x 2 mm, pressed along its cells by 10 % each."""
    ring = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    position = np.array(
        [[[*point, z * (1.0 - 0.1 * f)] for z in (0, 2) for point in ring] for f in range(frames)]
    )
    quads = np.array([[k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k] for k in range(4)])
    return {
        "strain": 0.1 * np.arange(frames),
        "time_s": 1.0 * np.arange(frames),
        "plate_y_m": np.column_stack([np.zeros(frames), 2.0 - 0.2 * np.arange(frames)]),
        "position_m": 1e-3 * position,
        "quads": quads,
        "quad_thickness_m": np.full(4, 1e-4),
    }


@dataclass(frozen=True)
class Named:
    """The id that a row made by hand has in place of a case."""

    case_id: str

    @staticmethod
    def to_json():
        """No case, which only its own reader notices."""
        return "{}"


def write(path, table, attributes=None, cases=(), ran=None):
    """A results file with these rows; finished cases have curves and shapes.

    cases : of the rows with real ones. ran : other curves and shapes of a row, by its number.
    """
    known = {case.case_id: case for case in cases}
    usual = {name: column.to_numpy() for name, column in there_and_back().items()}
    results = []
    for number, row in enumerate(table.to_dict("records")):
        case_id, status, message = (row.pop(name) for name in ("case_id", "status", "message"))
        shapes = tube() if row["direction"] == "out_of_plane" else squeezed_cell()
        found = (usual, shapes) if status == "converged" else ({}, {})
        case = known.get(case_id, Named(case_id))
        found = found if ran is None else ran(row, number)
        results.append(Result(case, Status(status), message, row, *found))
    with Writer(path, attributes=attributes) as writer:
        writer.append(results)
        writer.fold()
    return str(path)


def ids(ranking):
    """Rows of the summary in the order of their places."""
    return [int(case_id, 16) for case_id in ranking["case_id"]]
