"""Crushes of all infills on meshes from one element per wall up, each compared with the finest
one.
"""

from itertools import product

import numpy as np
import pandas as pd

from sweep.config.case import Case
from sweep.config.kinds.mesh import nodes_of
from sweep.design.lattice import build_network
from sweep.result import Status
from sweep.store.read import read_history
from tests.studies.rankings.spread import ALLOWED, CELLS, crush

MESHES = (1, 2, 3, 4, 6, 8)  # elements of a wall
FINEST = (12, 24)
BASE = 3  # elements of a wall, with whose cost others are compared
MASSES = (0.6e-3, 1.2e-3, 2.0e-3)  # kg: about 0.1, 0.2 and 0.35 of a solid block
DESIGNS = tuple(product(CELLS, product(("glued", "contact"), MASSES)))
COLUMNS = {
    "absorbed_energy_J": "energy per gram",
    "absorbed_energy_until_packed_J": "usable energy",
    "packing_strain": "dens. strain",
    "peak_force_until_packed_N": "peak force",
    "plateau_stress_iso_Pa": "plateau stress",
    **{f"absorbed_energy_at_{force:g}N_J": f"up to {force:g} N" for force in ALLOWED},
}
WINDOW, APART, LASTING = 0.02, 0.05, 3  # strain; share of the mean force; windows
NAMES = {"glued": "glued", "contact": "loose"}
DESIGN = ["infill", "platens", "g"]


def usual(design):
    """Elements of a wall of a design by default."""
    return nodes_of(design[0]) + 1


def cases_of(designs=DESIGNS, meshes=(*MESHES, *FINEST)):
    """The crush of every design, as in `spread`, on every mesh."""
    sizes = product(designs, meshes)
    return {(design, n): crush(design, n, imperfection=0.01, steps=200) for design, n in sizes}


def without_contact(cases):
    """The crushes between glued platens, with walls that pass through one another."""
    return {
        (design, n): Case.of(
            lattice=case.lattice,
            loading=case.loading,
            contact=dict(model="none"),
            solver=case.solver,
        )
        for (design, n), case in cases.items()
        if case.loading.platen == "glued"
    }


def slenderness(case):
    """Median length of a wall, joint to joint, / wall thickness."""
    network = build_network(case.lattice.geometry)
    start, end = network.points[network.walls].swapaxes(0, 1)
    return float(np.median(np.linalg.norm(end - start, axis=1) / network.wall_thickness))


def curve(file, case_id):
    """Strain and work of a crush in a results file, (rows,) each."""
    history = read_history(file, case_id)
    return history["strain"].to_numpy(), history["work_in_J"].to_numpy()


def parted(path, other):
    """The strain at which two crushes part, and stay apart for `LASTING` windows; else NaN.

    path, other: strain and work, (rows,) each. Mean forces over windows of strain are compared, so
    that a snap that is a little later is no other path.
    """
    edges = np.arange(0.0, min(path[0][-1], other[0][-1]) + 0.5 * WINDOW, WINDOW)
    force, beside = (np.diff(np.interp(edges, *each)) for each in (path, other))
    apart = np.abs(force - beside) > APART * np.fmax(np.abs(force), np.abs(beside))
    lasting = np.lib.stride_tricks.sliding_window_view(apart, LASTING).all(axis=1)
    return float(edges[lasting.argmax()]) if lasting.any() else np.nan


def compare(cases, rows, curves):
    """Every crush compared with the crush of its design on the finest mesh: a row for each.

    rows: the summary by case id; curves: case id -> (strain, work). `parted`: the strain at which
    the crush leaves the path of the finest mesh; `branches`: where the finest but one does, 0 if
    one of both failed; `default`: whether the mesh is the default of its infill; `work`: Newton
    iterations x elements. Other columns: relative errors.
    """
    *_, fine, finest = sorted({n for _, n in cases})
    found = []
    for (design, n), case in cases.items():
        ids = [cases[design, mesh].case_id for mesh in (n, fine, finest)]
        row, near, truth = (rows.loc[case_id] for case_id in ids)
        path, _, true_path = (curves[case_id] for case_id in ids)
        failed = [each["status"] != Status.CONVERGED for each in (row, near, truth)]
        kind, (platen, mass) = design
        found.append(
            {"infill": kind, "platens": NAMES[platen], "g": 1e3 * mass, "elements": n}
            | {"l/t": slenderness(case), "failed": failed[0], "default": n == usual(design)}
            | {"work": work(case, rows), "cpu": row["cpu_s"]}
            | {"parted": parted(path, true_path)}
            | {"branches": 0.0 if any(failed[1:]) else parted(curves[ids[1]], true_path)}
            | {name: abs(row[name] / truth[name] - 1.0) for name in COLUMNS}
        )
    return pd.DataFrame(found)


def work(case, rows):
    """Newton iterations x elements of a wall."""
    return (case.lattice.nodes_per_wall + 1) * rows.loc[case.case_id, "newton_iterations"]
