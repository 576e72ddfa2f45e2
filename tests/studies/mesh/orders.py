"""The order of the designs of the shipped sweeps at the default mesh and at a fine one."""

from sweep.ranking.scenes import by_scene
from sweep.report.tables.sheet import Sheet
from sweep.running.beside.refinement import refined
from tests.studies.rankings.orders import compared, merits

FINE = 12  # elements of a wall, at least
TIMES = 3  # as many as by default, at least
PATIENCE = 600.0  # s for a case


def finer(case):
    """The same case with more elements."""
    finest = refined(case, elements=max(FINE / min(case.lattice.pieces), TIMES))
    solver = finest.solver.model_copy(update={"time_limit": PATIENCE})
    return finest.model_copy(update={"solver": solver})


def by_order(usual, fine):
    """Correlations of all scenes; usual, fine: config -> rows in the order of its cases."""
    heads = ["config", "scene", "designs", "failed", "correlation", "same best", "worst place"]
    body = []
    for name, rows in usual.items():
        rows, others = (table[name].reset_index(drop=True) for table in (usual, fine))
        for label, scene in by_scene(rows).items():
            before, after = merits(scene), merits(others.loc[scene.index])
            known = before.notna() & after.notna()
            rho, same = compared(before, after)
            ranks = [merit[known].rank(ascending=False) for merit in (before, after)]
            moved = (ranks[0] - ranks[1]).abs().max()
            cells = [name, label, str(len(scene)), str(int((~known).sum()))]
            body.append([*cells, f"{rho:.3f}", "yes" if same else "no", f"{moved:g}"])
    notes = (
        f"Spearman's correlation of the order by default and with {FINE} or more elements; worst",
        "place: by how many places a design is off at most.",
    )
    return Sheet("Orders at the default and at a fine mesh", heads, body, notes=notes)
