"""The table of energies of wide panels and of the errors of narrow strips."""

from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from tests.studies.sides.panels import FAR, NARROW, STRAIN, WIDE, WIDEST, Strip, wide


def joules(row):
    """Energy, mJ/g; none for a run that stopped."""
    done = row["status"] == Status.CONVERGED
    return 1e3 * row["specific_absorption_J_per_g"] if done else float("nan")


def middle(*rows):
    """Energy over mass that the last row has more than the one before, mJ/g; NaN if one stopped.

    Both have the same edges.
    """
    narrow, wider = rows[-2:]
    gained = wider["absorbed_energy_J"] - narrow["absorbed_energy_J"]
    stopped = any(row["status"] != Status.CONVERGED for row in (narrow, wider))
    return float("nan") if stopped else 1e3 * gained / (wider["mass_g"] - narrow["mass_g"])


def table(rows):
    """A line for each infill and its platens; rows: of the summary, by `Strip`."""
    narrow = sorted({strip.cells for strip in rows} & {*NARROW})
    lines = []
    for kind, platens in dict.fromkeys((strip.kind, strip.platens) for strip in rows):
        panel = [rows[Strip(kind, platens, "free", n)] for n in wide(platens)]
        true = middle(*panel)
        line = [kind, platens, *map(number, (*map(joules, panel[: len(WIDE)]), true))]
        for sides in ("free", "periodic"):
            each = [joules(rows[Strip(kind, platens, sides, n)]) for n in narrow]
            line.append(" / ".join(number(100 * (one / true - 1), "+") for one in each))
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
            f"Middle: what {two} cells have more than {one} ({', '.join(FAR)}: {WIDEST} more "
            f"than {two}), energy / mass. Then errors in % of {cells} cells, with free and with "
            "tied sides. Smooth platens have no friction. -: a crush stopped.",
        ),
    )  # fmt: skip


def number(value, sign=""):
    """A number with one decimal."""
    return "-" if value != value else f"{value:{sign}.1f}"
