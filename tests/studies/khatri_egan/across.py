"""Prediction of a measured crush: a table, a tornado chart, curves.

`make experiment` runs `configs/khatri_egan_square.toml` and evaluates its results. The first case
of each kind of platens is a base case; every other case changes one key.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.signal import find_peaks

from sweep.config.load import load_config
from sweep.numbers import three_digits
from sweep.report.figures import case_plots
from sweep.report.tables.markdown import markdown
from sweep.report.tables.sheet import Sheet
from sweep.running.sweep import run_sweep
from sweep.store.read import read_history, read_summary
from tests.studies.panels import dress, legend
from tests.support.converged import demand

CONFIG = Path(__file__).parents[3] / "configs" / "khatri_egan_square.toml"
# N. R. Khatri and P. F. Egan 2024, mean and scatter of three specimens.
MEASURED, SCATTER = 0.12, 0.018  # J
MEASURED_PEAKS = 3
DROP = 0.05  # of a load: a drop that makes it a peak
SHOWN_FORCE = 50.0  # N
VISIBLE = 0.005  # of the base case: smaller changes of energy get no label

PLATENS = {
    "contact": ("loose", case_plots.BLUE),
    "sliding": ("stuck, upper slides", case_plots.SKY),
    "glued": ("stuck", case_plots.ORANGE),
}


class Factor(NamedTuple):
    """Name of a changed key, and the unit of its values, which is `scale` in SI."""

    name: str
    unit: str = ""
    scale: float = 1.0

    def text(self, value):
        """A value in words."""
        return value if isinstance(value, str) else f"{value / self.scale:g} {self.unit}".strip()


FACTORS = {
    "contact.friction": Factor("friction"),
    "contact.stiffness": Factor("stiffness of contact"),
    "material.modulus": Factor("modulus", "MPa", 1e6),
    "material.plane": Factor("plane"),
    "material.bend": Factor("bending"),
    "material.stretch": Factor("stretching"),
    "lattice.imperfection": Factor("bow, in wall thicknesses"),
    "lattice.grading": Factor("wall at top / at bottom"),
    "lattice.nodes_per_wall": Factor("nodes inside a wall"),
    "solver.load_steps": Factor("load steps"),
    "solver.joints": Factor("joints"),
    "damping.relaxation_time": Factor("real speed, relaxation time", "s"),
    "material.loss": Factor("real speed, loss"),
}


def predictions(path):
    """The summary of a results file, with the key and the value that each case changes.

    Added columns: `factor` and `value` in words, "" in a base case; `peaks`, number of load peaks.
    """
    table = read_summary(path)
    demand(table.to_dict("records"))
    changes = [_change(row, table.iloc[0]) for _, row in table.iterrows()]
    loads = [read_history(path, case_id)["reaction_top_N"] for case_id in table["case_id"]]
    return table.assign(
        factor=[factor for factor, _ in changes],
        value=[value for _, value in changes],
        peaks=[load_peaks(load.to_numpy()) for load in loads],
    )


def _change(row, base):
    """The name of the key that a case changes, and its value in words."""
    for key, factor in FACTORS.items():
        if row[key] == row[key] and row[key] != base[key]:
            return factor.name, factor.text(row[key])
    return "", ""


def load_peaks(force):
    """Number of peaks of a load (rows,): drops by `DROP` of the peak before a higher load."""
    peaks, found = find_peaks(force, prominence=0.0)
    return int(np.sum(found["prominences"] >= DROP * force[peaks]))


def sheet(table):
    """A table of all cases, one row per case."""
    columns = {
        "platens": [PLATENS[name][0] for name in table["platen"]],
        "changed": [f"{row.factor} {row.value}".strip() or "base" for row in table.itertuples()],
        "absorbed, J": digits(table["absorbed_energy_J"]),
        "/ measured": digits(table["absorbed_energy_J"] / MEASURED),
        "load peaks": [str(count) for count in table["peaks"]],
        "packed at, mm": digits(1e3 * table["densification_strain"] * table["height_m"]),
        "greatest force, N": digits(table["peak_force_N"]),
        "within the model, J": digits(table["absorbed_energy_within_model_J"]),
        "least element strain": [f"{strain:.2f}" for strain in table["least_element_strain"]],
        "kept area": [f"{share:.2f}" for share in table["kept_area"]],
    }
    rows = [list(row) for row in zip(*columns.values(), strict=True)]
    return Sheet("", list(columns), rows, notes=(verdict(table),))


def digits(values):
    return [three_digits(value) for value in values]


def verdict(table):
    """Sentences that compare the range of predictions with the measurement."""
    energy, base = table["absorbed_energy_J"], _bases(table)
    ranges = energy.groupby(table["platen"]).agg(["min", "max"])
    predicted = "; ".join(
        f"{PLATENS[name][0]}: {base[name]:.3f} J in the base case, {low:.3f} to {high:.3f} J in all"
        for name, (low, high) in zip(ranges.index, ranges.to_numpy(), strict=True)
    )
    hits = int((abs(energy - MEASURED) <= SCATTER).sum())
    return (
        f"Energy absorbed up to {_stroke(table)}, platens {predicted}. Measured: {MEASURED:g} +/- "
        f"{SCATTER:g} J; {hits} of {len(table)} cases are within this range. Load peaks: "
        f"{table['peaks'].min()} to {table['peaks'].max()}; measured: {MEASURED_PEAKS}. "
        f"The model is not validated for a crush by {100 * table['peak_strain'].max():.0f} %: the "
        f"shortest element has {1 + table['least_element_strain'].min():.2f} of its rest length, "
        f"and the walls cover at least {table['kept_area'].min():.2f} of the printed area."
    )


def _stroke(table):
    return f"{1e3 * table['stroke_m'].iloc[0]:g} mm"


def _bases(table):
    """Energy of the base case for each kind of platens."""
    return table[table["factor"] == ""].set_index("platen")["absorbed_energy_J"]


def tornado(ax, table):
    """Range of absorbed energies of the cases that change a factor, one bar per kind of platens."""
    base, changed = _bases(table), table[table["factor"] != ""]
    off = (changed["absorbed_energy_J"] - changed["platen"].map(base)).abs()
    factors = off.groupby(changed["factor"]).max().sort_values().index
    band = {"color": case_plots.PLATEN, "label": f"measured, {MEASURED:g} ± {SCATTER:g} J"}
    ax.axvspan(MEASURED - SCATTER, MEASURED + SCATTER, lw=0, **band)
    for row, (platen, (words, color)) in enumerate(PLATENS.items()):
        ax.axvline(base[platen], color=color, lw=1.2, zorder=1)
        for place, factor in enumerate(factors):
            rows = changed[(changed["platen"] == platen) & (changed["factor"] == factor)]
            energies = rows.set_index("value")["absorbed_energy_J"]
            _bar(ax, place + 0.27 * (1 - row), energies, base[platen], color)
        ax.plot([], [], lw=6.0, color=color, label=f"platens {words}; line: base case")
    dress(ax, f"energy absorbed up to {_stroke(table)}, J", "")
    ax.set_yticks(range(len(factors)), [f"{name}{_base_value(table, name)}" for name in factors])
    ax.grid(visible=False, axis="y")
    ax.set(xlim=(0.0, 1.12 * table["absorbed_energy_J"].max()), ylim=(-0.6, len(factors) - 0.4))


def _base_value(table, name):
    """The value of a factor in the base case, if it has one."""
    key = next(key for key, factor in FACTORS.items() if factor.name == name)
    value = table[key].iloc[0]
    return f": {FACTORS[key].text(value)}" if value == value else ""


def _bar(ax, y, energies, base, color):
    """A bar from the least to the greatest energy, base included, labelled with the values."""
    low, high = min(base, energies.min()), max(base, energies.max())
    ax.barh(y, high - low, left=low, height=0.25, color=color)
    for end, value, side, shift in (
        (low, energies.idxmin(), "right", -3),
        (high, energies.idxmax(), "left", 3),
    ):
        if abs(end - base) > VISIBLE * base:
            ax.annotate(value, (end, y), (shift, 0), textcoords="offset points", ha=side,
                        va="center", fontsize="x-small")  # fmt: skip


def curves(axes, path, table):
    """Load and absorbed energy over travel: the base cases, the extremes, and all others."""
    energy = table["absorbed_energy_J"]
    bases = table[table["factor"] == ""]
    named = {
        row.case_id: (f"platens {PLATENS[row.platen][0]}", PLATENS[row.platen][1])
        for row in bases.itertuples()
    }
    for place, color in (
        (energy.idxmin(), case_plots.PURPLE),
        (energy.idxmax(), case_plots.VERMILION),
    ):
        row = table.loc[place]
        words = f"{PLATENS[row['platen']][0]}, {row['factor']} {row['value']}"
        named.setdefault(row["case_id"], (words, color))
    for case_id in table["case_id"]:
        past = read_history(path, case_id)
        words, color = named.get(case_id, ("", case_plots.PLATEN))
        look = {"color": color, "lw": 2.0 if words else 0.7, "zorder": 3 if words else 2}
        travel = 1e3 * past["top_displacement_m"]
        axes[0].plot(travel, past["reaction_top_N"], label=words or None, **look)
        axes[1].plot(travel, past["work_in_J"], **look)
    _measured(axes, float(table["stroke_m"].iloc[0]))


def _measured(axes, stroke):
    """The measured values, and the names of the axes."""
    load, work = axes
    mean = MEASURED / stroke
    load.axhline(mean, color="black", lw=1.0, ls=":", label=f"measured mean, {mean:.3g} N")
    whole = f"measured, {MEASURED:g} ± {SCATTER:g} J"
    look = {"fmt": "o", "color": "black", "capsize": 4, "zorder": 4, "label": whole}
    work.errorbar(1e3 * stroke, MEASURED, SCATTER, **look)
    dress(load, "travel of the platen, mm", "load, N")
    dress(work, "travel of the platen, mm", "absorbed energy, J")
    load.set_ylim(0.0, SHOWN_FORCE)
    work.set_ylim(bottom=0.0)


def report(path):
    """Write the pictures and the table of a results file beside it; return the table."""
    table, folder = predictions(path), path.parent
    text = markdown([sheet(table)])
    (folder / "experiment.md").write_text(text, encoding="utf-8")
    chart = case_plots.blank(9.0, 7.0)
    tornado(ax := chart.subplots(), table)
    legend(ax, loc="lower left", bbox_to_anchor=(0, 1), ncols=2)
    case_plots.save(chart, folder / "tornado.png")
    figure = case_plots.blank(9.0, 4.4)
    curves(tuple(figure.subplots(1, 2)), path, table)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize="small")
    case_plots.save(figure, folder / "force_displacement.png")
    return text


def main(folder):
    """Simulate the cases that the results file in a folder lacks, and report."""
    config = load_config(CONFIG)
    path = folder / f"{config.name}.h5"
    run_sweep(config, path)
    sys.stdout.write(report(path))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
