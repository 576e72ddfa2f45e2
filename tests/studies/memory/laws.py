"""What laws of the walls cost: processor time of a crush against that of elastic sections."""

from sweep.config.case import Case
from sweep.report.tables.sheet import Sheet
from sweep.simulation.simulate import simulate
from tests.studies.bench.measuring.clock import medians, seconds

ROUNDS = 9
LOSS = {"loss": 0.4}
STRAIN = 0.6
FIBRES = (5, 7, 9)
USUAL = "section"
LAWS = {
    "linear": {"stretch": "linear"},
    USUAL: {},
    **{f"fibres {n}": {"bend": "fibres", "fibres": n} for n in FIBRES},
    "linear, loss": {"stretch": "linear", **LOSS},
    "section, loss": LOSS,
    **{f"fibres {n}, loss": {"bend": "fibres", "fibres": n, **LOSS} for n in FIBRES},
    **{f"ABS, fibres {n}": {"name": "abs", "fibres": n} for n in FIBRES},
}


def case_of(material):
    """A grid of 3 x 3 cells crushed to `STRAIN`."""
    return Case.of(
        lattice={},
        material=material,
        loading=dict(mode="displacement", strain=STRAIN),
    )


def prices(laws=LAWS, rounds=ROUNDS):
    """Median processor time and iterations of every law; all laws run in turn, round by round."""
    cases = {name: case_of(material) for name, material in laws.items()}
    counts = {name: simulate(case).summary["newton_iterations"] for name, case in cases.items()}
    runs = {name: lambda case=case: seconds(lambda: simulate(case)) for name, case in cases.items()}
    spent = medians(runs, rounds)
    unit, usual = spent[USUAL], spent[USUAL] / counts[USUAL]
    rows = [
        [
            name,
            f"{1e3 * spent[name]:.0f}",
            f"{spent[name] / unit:.2f}",
            f"{count}",
            f"{spent[name] / count / usual:.2f}",
        ]
        for name, count in counts.items()
    ]
    heads = ["law", "time ms", "over section", "iterations", "an iteration over section"]
    notes = (f"3 x 3 cells to 60 % and back; medians of {rounds} rounds. loss: 40 %.",)
    return Sheet("The price of a law", heads, rows, notes=notes)
