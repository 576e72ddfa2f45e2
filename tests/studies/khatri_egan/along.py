"""Predictions of crushes along the cells, in platens that are not known: a table and curves.

`make along` runs `configs/khatri_egan_square_out_of_plane.toml`, which was measured, and
`configs/khatri_egan_hexagon_out_of_plane.toml`, whose measurement has not been looked up; and the
base cases of `configs/khatri_egan_square.toml`, pressed across their cells, to compare with.
"""

import sys
from pathlib import Path

import numpy as np

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.report.figures import case_plots
from sweep.report.tables.markdown import markdown
from sweep.report.tables.sheet import Sheet
from sweep.running.sweep import run_sweep
from sweep.store.read import read_history, read_summary
from tests.studies.khatri_egan import across
from tests.studies.panels import dress, legend
from tests.support.converged import demand

CONFIGS = Path(__file__).parents[3] / "configs"
NAMES = {
    "square": "khatri_egan_square_out_of_plane",
    "hexagon": "khatri_egan_hexagon_out_of_plane",
}
# N. R. Khatri and P. F. Egan 2024: mean and scatter of three square specimens, J.
MEASURED = {"square": (2.18, 0.35)}
PLATENS = {
    "glued": ("stuck", case_plots.ORANGE),
    "clamped": ("stuck, upright", case_plots.PURPLE),
    "contact": ("loose", case_plots.BLUE),
}
DASHES = ("-", "--", ":")  # of curves, by friction
HALF = 0.5  # strain, up to which loads are drawn in full
SHOWN = 2.5  # greatest load that is drawn / greatest load up to half
COMPARED = 0.5  # friction of the cases that are compared with those across the cells


def first_peak(force):
    """The first load in N, of rows (r,), that is followed by a drop; NaN if it never drops."""
    falls = np.flatnonzero(np.diff(force) < 0.0)
    return float(force[falls[0]]) if falls.size else np.nan


def predictions(path):
    """The summary of a results file, with `to_half_J`, to 50 % strain, and `first_peak_N`."""
    table = read_summary(path)
    demand(table.to_dict("records"))
    histories = [read_history(path, case_id) for case_id in table["case_id"]]
    return table.assign(
        to_half_J=[np.interp(HALF, past["strain"], past["work_in_J"]) for past in histories],
        first_peak_N=[first_peak(history["reaction_top_N"].to_numpy()) for history in histories],
    )


def sheet(cells, table, others):
    """A table of the cases of one shape of ``cells``, a row each. others: `bases_across`."""
    columns = {
        "platens": [PLATENS[name][0] for name in table["platen"]],
        "friction": [f"{value:g}" for value in table["contact.friction"]],
        "first peak, N": across.digits(table["first_peak_N"]),
        "to 50 %, J": across.digits(table["to_half_J"]),
        "within the model, J": across.digits(table["absorbed_energy_within_model_J"]),
        "absorbed, J": across.digits(table["absorbed_energy_J"]),
        "iterations": [f"{count:,}" for count in table["newton_iterations"]],
        "CPU, s": across.digits(table["cpu_s"]),
    }
    rows = [list(row) for row in zip(*columns.values(), strict=True)]
    return Sheet(cells, list(columns), rows, notes=tuple(_notes(cells, table, others)))


def _notes(cells, table, others):
    """Sentences on the range of predictions, and known facts on it."""
    energy, stroke = table["absorbed_energy_J"], 1e3 * table["stroke_m"].iloc[0]
    solid = table["solid_strain"].iloc[0]
    yield (
        f"Energy absorbed up to {stroke:g} mm: {_span(energy)} J. Up to "
        f"{100 * solid:.0f} %, where the walls fill the pressed area: "
        f"{_span(table['absorbed_energy_within_model_J'])} J."
    )
    if cells not in MEASURED:
        yield "Not compared with any measurement."
        return
    mean, scatter = MEASURED[cells]
    hits = int((abs(energy - mean) <= scatter).sum())
    yield f"Measured: {mean:g} +/- {scatter:g} J; {hits} of {len(table)} cases are within it."
    along = energy[table["contact.friction"] == COMPARED]
    results = "; ".join(
        f"{across.PLATENS[row.platen][0]}, {row.absorbed_energy_J:.3f} J: "
        f"{_span(along / row.absorbed_energy_J, 1)}"
        for row in others.itertuples()
    )
    yield (
        f"Energy along / across the cells with friction {COMPARED:g}, for each kind of platens "
        f"across: {results}. Measured: {mean / across.MEASURED:.0f}."
    )


def _span(values, digits=2):
    return f"{values.min():.{digits}f} to {values.max():.{digits}f}"


def curves(axes, path, cells, table):
    """Load and absorbed energy over travel."""
    load, work = axes
    friction, greatest = sorted(set(table["contact.friction"])), 0.0
    for row in table.to_dict("records"):
        past = read_history(path, row["case_id"])
        words, color = PLATENS[row["platen"]]
        dashes = DASHES[friction.index(row["contact.friction"])]
        look = {"color": color, "ls": dashes, "lw": 1.2,
                     "label": f"{words}, friction {row['contact.friction']:g}"}  # fmt: skip
        greatest = max(greatest, past["reaction_top_N"][past["strain"] <= HALF].max())
        travel = 1e3 * past["top_displacement_m"]
        load.plot(travel, past["reaction_top_N"], **look)
        work.plot(travel, past["work_in_J"], **look)
    if cells in MEASURED:
        mean, scatter = MEASURED[cells]
        dot = {"fmt": "o", "color": "black", "capsize": 4, "zorder": 4}
        work.errorbar(1e3 * table["stroke_m"].iloc[0], mean, scatter, **dot)
    dress(load, "travel of the platen, mm", f"load, N: {cells}s")
    dress(work, "travel of the platen, mm", "absorbed energy, J")
    load.set_ylim(0.0, SHOWN * greatest)
    work.set_ylim(bottom=0.0)


def report(folder):
    """Write the table and the picture of the results in a folder; return the table."""
    paths = {cells: folder / f"{name}.h5" for cells, name in NAMES.items()}
    tables = {cells: predictions(path) for cells, path in paths.items() if path.exists()}
    others = bases_across(folder)
    text = markdown([sheet(cells, table, others) for cells, table in tables.items()])
    (folder / "along.md").write_text(text, encoding="utf-8")
    figure = case_plots.blank(9.0, 3.6 * len(tables))
    grid = figure.subplots(len(tables), 2, squeeze=False)
    for axes, (cells, table) in zip(grid, tables.items(), strict=True):
        curves(axes, paths[cells], cells, table)
    legend(grid[0, 1], loc="upper left")
    case_plots.save(figure, folder / "along.png")
    return text


def bases_across(folder):
    """The summary of the base cases across the cells that are in a folder."""
    table = across.predictions(folder / f"{across.CONFIG.stem}.h5")
    return table[table["factor"] == ""]


def main(folder):
    """Simulate the cases that the results files in a folder lack, and report."""
    folder.mkdir(parents=True, exist_ok=True)
    every = expand(load_config(across.CONFIG))
    bases = {case.loading.platen: case for case in reversed(every)}
    run_sweep(list(bases.values()), folder / f"{across.CONFIG.stem}.h5")
    for name in NAMES.values():
        config = load_config(CONFIGS / f"{name}.toml")
        run_sweep(config, folder / f"{name}.h5")
    sys.stdout.write(report(folder))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
