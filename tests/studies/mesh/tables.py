"""Tables of the errors of meshes: by column, by common features of the designs, by design."""

import numpy as np
import pandas as pd

from sweep.config.kinds.mesh import EIGHT, TWELVE, WITH_EIGHT
from sweep.numbers import short, tenths
from sweep.report.tables.sheet import Sheet
from tests.studies.mesh.crushes import APART, BASE, COLUMNS, DESIGN, FINEST, LASTING, WINDOW
from tests.studies.rankings.spread import nine_of_ten

MIDDLE, MOST = 0.01, 0.02  # errors allowed in the middle, and in nine of ten designs
SLENDER = (0.0, 6.0, 12.0, np.inf)  # edges of groups of wall length / thickness


def averaged(found):
    """The rows that enter averages: of designs with a truth, where the crush converged."""
    return found[found["branches"].isna() & ~found["failed"]]


def pair(middle, most):
    """Two shares in percent: of the median, and of the ninth decile."""
    return f"{tenths(middle)} / {tenths(most)}"


def by_column(found, title="Errors by column"):
    """Errors of each column on each mesh, and the cost of the mesh."""
    known = averaged(found)
    meshes = sorted(found["elements"].unique())[:-1]
    groups = [known[known["elements"] == n] for n in meshes]
    by_default = known[known["default"]]
    rows = [
        [
            text,
            *(
                pair(group[name].median(), nine_of_ten(group[name]))
                for group in (*groups, by_default)
            ),
        ]
        for name, text in COLUMNS.items()
    ]
    every = [found[found["elements"] == n].set_index(DESIGN) for n in meshes]
    every.append(found[found["default"]].set_index(DESIGN))
    base = found[found["elements"] == BASE].set_index(DESIGN)
    rows.append(["paths part", *(str(group["parted"].notna().sum()) for group in every)])
    rows.append(["failed", *(str(group["failed"].sum()) for group in every)])
    for name, text in {"work": "work", "cpu": "processor time"}.items():
        ratios = [(group[name] / base[name]).median() for group in every]
        rows.append([text, *(f"{ratio:.2f}" for ratio in ratios)])
    entering, designs = (len(each[DESIGN].drop_duplicates()) for each in (known, found))
    notes = (
        f"Errors in %, beside {FINEST[-1]} elements a wall: the middle one / that of nine of ten.",
        f"{entering} of {designs} designs enter; the finest meshes of the others failed or part.",
        "Energies to 60 %, until densification, up to forces; peak force until then; ISO plateau.",
        f"Paths part where mean forces over {100 * WINDOW:g} % of strain differ by "
        f"{100 * APART:g} %, {LASTING} times on end.",
        f"Work: iterations x elements. Work and time are medians, {BASE} elements being 1.",
        f"default: {EIGHT + 1} elements in {', '.join(WITH_EIGHT)} cells, else {TWELVE + 1}.",
        verdict(dict(zip(meshes, groups, strict=True)), by_default),
    )
    return Sheet(title, ["elements a wall", *map(str, meshes), "default"], rows, notes=notes)


def verdict(groups, by_default):
    """Which mesh is the cheapest with small errors in every column, and whether the default has
    them; groups: mesh -> rows.
    """
    bounds = f"{100 * MIDDLE:g} / {100 * MOST:g} % in every column"
    enough = [n for n, group in groups.items() if is_within(group)]
    default = "so is the default" if is_within(by_default) else "the default is not"
    if not enough:
        return f"No mesh of these is within {bounds}; {default}."
    return f"Within {bounds}: {enough[0]} elements a wall; {default}."


def is_within(group):
    """Whether the errors of rows are small in every column, in the middle and in nine of ten."""
    errors = group[list(COLUMNS)]
    return bool((errors.median() <= MIDDLE).all() and (errors.quantile(0.9) <= MOST).all())


def by_group(found):
    """The worst column of each mesh, by common features of the designs."""
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
