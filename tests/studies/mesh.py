"""How many elements a wall needs: every column of a ranking beside a converged mesh.

Run by `make mesh`: all infills, light and heavy, glued and loose, crushed to 60 % with one element
per wall and with more, up to `FINEST`; the last stands for the truth. Where the two finest meshes
follow different paths there is no truth: such designs are marked and enter no average.
Finished cases are kept in the given folder.
"""

import sys
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from sweep.config.case import Lattice
from sweep.numbers import short, tenths
from sweep.report.markdown import markdown
from sweep.report.sheets import Sheet
from sweep.result import Status
from sweep.running.error_bars import companions, error_bars
from sweep.running.sweep import run_sweep
from sweep.scene.mesh import build_mesh
from sweep.store.read import read_history, read_summary
from tests.studies.bars import beside_finer, coverage
from tests.studies.spread import ALLOWED, CELLS, crush, nine_of_ten

MESHES = (1, 2, 3, 4, 6, 8)  # elements of a wall
FINEST = (12, 24)
USUAL = Lattice().nodes_per_wall + 1
MASSES = (0.6e-3, 1.2e-3, 2.0e-3)  # kg: about 0.1, 0.2 and 0.35 of a solid block
DESIGNS = tuple(product(CELLS, product(("glued", "contact"), MASSES)))
COLUMNS = {
    "absorbed_energy_J": "energy per gram",
    "absorbed_energy_until_packed_J": "until packed",
    "packing_strain": "packing strain",
    "peak_force_until_packed_N": "peak force",
    "plateau_stress_iso_Pa": "plateau stress",
    **{f"absorbed_energy_at_{force:g}N_J": f"up to {force:g} N" for force in ALLOWED},
}
MIDDLE, MOST = 0.01, 0.02  # errors allowed in the middle, and in nine of ten designs
WINDOW, APART, LASTING = 0.02, 0.05, 3  # strain; share of the mean force; windows
NAMES = {"glued": "glued", "contact": "loose"}
SLENDER = (0.0, 6.0, 12.0, np.inf)  # edges of groups of wall length / thickness
DESIGN = ["infill", "platens", "g"]


def cases_of(designs=DESIGNS, meshes=(*MESHES, *FINEST)):
    """The crush of every design, as those of `spread`, on every mesh."""
    sizes = product(designs, meshes)
    return {(design, n): crush(design, n, imperfection=0.01, steps=200) for design, n in sizes}


def slenderness(case):
    """Median length of a wall, joint to joint, / wall thickness."""
    mesh = build_mesh(case.lattice)
    return float(np.median(mesh.rest_length * mesh.pieces / mesh.thickness))


def parted(curve, other):
    """The strain at which two crushes part, and stay apart for `LASTING` windows; else NaN.

    curves: strain and work, (rows,) each. Compared are mean forces over windows of strain, so that
    a snap that is a little later is no other path.
    """
    edges = np.arange(0.0, min(curve[0][-1], other[0][-1]) + 0.5 * WINDOW, WINDOW)
    force, beside = (np.diff(np.interp(edges, *each)) for each in (curve, other))
    apart = np.abs(force - beside) > APART * np.fmax(np.abs(force), np.abs(beside))
    lasting = np.lib.stride_tricks.sliding_window_view(apart, LASTING).all(axis=1)
    return float(edges[lasting.argmax()]) if lasting.any() else np.nan


def compare(cases, rows, curves):
    """Every crush beside the one of its design on the finest mesh: a row for each.

    rows: the summary by case id; curves: case id -> (strain, work). `parted`: the strain at which
    the crush leaves the path of the finest mesh; `branches`: where the finest but one does, 0 if
    one of both failed; `work`: Newton iterations x elements. Other columns: relative errors.
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
            | {"l/t": slenderness(case), "failed": failed[0]}
            | {"work": work(case, rows), "cpu": row["cpu_s"]}
            | {"parted": parted(path, true_path)}
            | {"branches": 0.0 if any(failed[1:]) else parted(curves[ids[1]], true_path)}
            | {name: abs(row[name] / truth[name] - 1.0) for name in COLUMNS}
        )
    return pd.DataFrame(found)


def averaged(found):
    """The rows that enter averages: of designs with a truth, where the crush converged."""
    return found[found["branches"].isna() & ~found["failed"]]


def pair(middle, most):
    """Two shares in percent: of the middle one, and what nine of ten do not exceed."""
    return f"{tenths(middle)} / {tenths(most)}"


def by_column(found):
    """Errors of each column on each mesh, and what the mesh costs."""
    known = averaged(found)
    meshes = sorted(found["elements"].unique())[:-1]
    groups = [known[known["elements"] == n] for n in meshes]
    rows = [
        [text, *(pair(group[name].median(), nine_of_ten(group[name])) for group in groups)]
        for name, text in COLUMNS.items()
    ]
    every = [found[found["elements"] == n].set_index(DESIGN) for n in meshes]
    usual = found[found["elements"] == USUAL].set_index(DESIGN)
    rows.append(["paths part", *(str(group["parted"].notna().sum()) for group in every)])
    rows.append(["failed", *(str(group["failed"].sum()) for group in every)])
    for name, text in {"work": "work", "cpu": "processor time"}.items():
        ratios = [(group[name] / usual[name]).median() for group in every]
        rows.append([text, *(f"{ratio:.2f}" for ratio in ratios)])
    notes = (
        f"Errors in %, beside {FINEST[-1]} elements a wall: the middle one / that of nine of ten.",
        "Energies to 60 %, until packed, and up to forces; peak force until packed; ISO plateau.",
        f"Paths part where mean forces over {100 * WINDOW:g} % of strain differ by "
        f"{100 * APART:g} %, {LASTING} times on end.",
        f"Work: iterations x elements. Work and time are medians, {USUAL} elements being 1.",
        verdict(dict(zip(meshes, groups, strict=True))),
    )
    return Sheet("Errors by column", ["elements a wall", *map(str, meshes)], rows, notes=notes)


def verdict(groups):
    """Which mesh is the cheapest with small errors in every column; groups: mesh -> rows."""
    bounds = f"{100 * MIDDLE:g} / {100 * MOST:g} % in every column"
    for n, group in groups.items():
        errors = group[list(COLUMNS)]
        if (errors.median() <= MIDDLE).all() and (errors.quantile(0.9) <= MOST).all():
            return f"The cheapest mesh with {bounds}: {n} elements a wall."
    return f"No mesh of these has {bounds}."


def by_group(found):
    """The worst column of each mesh, by what the designs have in common."""
    known = averaged(found)
    meshes = sorted(found["elements"].unique())[:-1]
    bands = pd.cut(known["l/t"], SLENDER).map(lambda band: f"l/t {band.left:g} to {band.right:g}")
    rows = []
    for key in (known["platens"], bands, known["infill"]):
        for name, alike in known.groupby(key, sort=False, observed=True):
            groups = [alike.loc[alike["elements"] == n, list(COLUMNS)] for n in meshes]
            worst = [(group.median().max(), group.quantile(0.9).max()) for group in groups]
            rows.append([str(name), *(pair(*errors) for errors in worst)])
    return Sheet("Greatest errors of any column", ["designs", *map(str, meshes)], rows)


def by_design(found):
    """The greatest error of any column for every design, and where paths part."""
    meshes = sorted(found["elements"].unique())[:-1]
    rows = []
    for design, group in found.groupby(DESIGN, sort=False):
        by_mesh = group.set_index("elements")
        marks = np.where(by_mesh["failed"], "x", np.where(by_mesh["parted"].notna(), "*", ""))
        shares = by_mesh[list(COLUMNS)].max(axis=1).map(tenths) + marks
        first = group.iloc[0]
        at = "" if np.isnan(first["branches"]) else f"{100 * first['branches']:g} %"
        rows.append([*map(short, design), f"{first['l/t']:.1f}", at, *shares[meshes]])
    heads = [*DESIGN, "l/t", "branches", *map(str, meshes)]
    notes = (
        "Greatest error of any column in %; *: on another path than the finest mesh; x: failed.",
        "Branches: where the two finest meshes part; such a design enters no average.",
    )
    return Sheet("Errors by design", heads, rows, notes=notes)


def covered(cases, rows):
    """How many error bars of the usual mesh cover the error, by column: the sheet of `bars`.

    The notes tell what the bars cost, and whether the designs that are no ties are in order.
    """
    designs = {design: case for (design, n), case in cases.items() if n == USUAL}
    known = dict(zip(rows.index, rows.to_dict("records"), strict=True))
    bars = {case.case_id: error_bars(case, known) for case in designs.values()}
    finest = max(n for _, n in cases)
    barred = rows.loc[list(bars)].join(pd.DataFrame(bars).T)
    truth = rows.loc[[cases[design, finest].case_id for design in designs]]
    both = [[each.case for each in companions(case)] for case in designs.values()]
    spent = sum(work(case, rows) for pair in both for case in pair)
    alone = sum(work(case, rows) for case in designs.values())
    compared = "absorbed_energy_until_packed_J"
    values, limits = (table[compared] / table["mass_g"] for table in (barred, truth))
    corrections = barred[f"correction_{compared}"] / barred["mass_g"]
    platens = np.array([platen for _, (platen, _) in designs])
    counts = sum(
        order(*(column.to_numpy()[platens == platen] for column in (values, corrections, limits)))
        for platen in set(platens)
    )
    notes = (
        f"With its error bars the sweep is {1.0 + spent / alone:.1f} x the work.",
        "Of {} pairs of designs, {} are in the wrong order; {} of these tie, and {} others.".format(
            *counts
        ),
    )
    return coverage(beside_finer(barred, truth))._replace(notes=notes)


def order(values, corrections, limits):
    """Numbers of pairs: in all, in the wrong order, of these ties, and other ties, (4,)."""
    one, other = np.triu_indices(len(values), 1)
    gap = values[one] - values[other]
    wrong = gap * (limits[one] - limits[other]) < 0.0
    tied = np.abs(gap) <= np.abs(corrections[one] - corrections[other])
    return np.array([len(gap), wrong.sum(), (wrong & tied).sum(), (tied & ~wrong).sum()])


def work(case, rows):
    """Newton iterations x elements of a wall."""
    return (case.lattice.nodes_per_wall + 1) * rows.loc[case.case_id, "newton_iterations"]


def main(folder):
    """Run what is missing, and print the tables."""
    folder.mkdir(parents=True, exist_ok=True)
    cases, file = cases_of(), folder / "mesh.h5"
    usual = [case for (_, n), case in cases.items() if n == USUAL]
    others = [companion.case for case in usual for companion in companions(case)]
    every = {case.case_id: case for case in (*cases.values(), *others)}
    run_sweep(list(every.values()), file)
    rows = read_summary(file).set_index("case_id")
    histories = {case.case_id: read_history(file, case.case_id) for case in cases.values()}
    curves = {
        case_id: (history["strain"].to_numpy(), history["work_in_J"].to_numpy())
        for case_id, history in histories.items()
    }
    found = compare(cases, rows, curves)
    text = markdown([by_column(found), by_group(found), by_design(found), covered(cases, rows)])
    (folder / "mesh.md").write_text(text, "utf-8")
    sys.stdout.write(text)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
