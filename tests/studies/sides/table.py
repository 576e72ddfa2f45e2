"""The table of energies of wide panels and of the errors of narrow strips."""

from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from tests.studies.sides.panels import NARROW, STRAIN, WIDE, Strip


def joules(row):
    """Energy, mJ/g; of what stopped, none."""
    done = row["status"] == Status.CONVERGED
    return 1e3 * row["specific_absorption_J_per_g"] if done else float("nan")


def middle(narrow, wide):
    """Energy over mass by which one row exceeds another, mJ/g: both have the same edges."""
    gained = wide["absorbed_energy_J"] - narrow["absorbed_energy_J"]
    return 1e3 * gained / (wide["mass_g"] - narrow["mass_g"])


def table(rows):
    """A line for each infill and its platens; rows: of the summary, by `Strip`."""
    narrow = sorted({strip.cells for strip in rows} & {*NARROW})
    lines = []
    for kind, platens in dict.fromkeys((strip.kind, strip.platens) for strip in rows):
        wide = [rows[Strip(kind, platens, "free", n)] for n in WIDE]
        true = middle(*wide) if all(row["status"] == Status.CONVERGED for row in wide) else None
        line = [kind, platens, *(f"{joules(row):.1f}" for row in wide)]
        line.append("-" if true is None else f"{true:.1f}")
        for sides in ("free", "periodic"):
            each = [joules(rows[Strip(kind, platens, sides, n)]) for n in narrow]
            line.append(" / ".join("-" if true is None else error(one, true) for one in each))
        lines.append(line)
    cells = " / ".join(map(str, narrow))
    one, two = WIDE
    return Sheet(
        "Narrow strips beside the middle of a wide panel",
        ["infill", "platens", f"{one} free", f"{two} free", "middle", f"free {cells}",
         f"tied {cells}"],
        lines,
        notes=(
            f"Energy to {100 * STRAIN:g} %, mJ/g, of {one} and {two} cells with free sides. "
            f"Middle: what {two} cells have more than {one}, energy / mass. Then errors in % of "
            f"{cells} cells, with free and with tied sides. Smooth platens have no friction. "
            "-: a crush stopped.",
        ),
    )  # fmt: skip


def error(value, true):
    """A relative error in %."""
    return "-" if value != value else f"{100 * (value / true - 1):+.1f}"
