"""Effects of a material with a memory.

Run by `make memory`: the loss of lattices against the loss of their material, crushes at rates over
five decades, the order of the designs of the shipped sweeps with and without each part, and error
against run time. Finished cases are kept in the given folder.
"""

import sys
from pathlib import Path

from tests.studies.memory.costs import costs
from tests.studies.memory.cycles import cycles, losses, rated, rates
from tests.studies.memory.orders import by_loss, table, variants
from tests.studies.tables import publish
from tests.support.converged import swept

CONFIGS = Path(__file__).parents[3] / "configs"


def main(folder):
    """Run the missing cases, and print the tables."""
    folder.mkdir(parents=True, exist_ok=True)
    file, orders = folder / "memory.h5", variants(CONFIGS)
    crushes, at_rates = cycles(), rated()
    cases = [
        *crushes.values(),
        *at_rates.values(),
        *(c for group in orders.values() for c in group),
    ]
    rows = swept(cases, file).set_index("case_id", drop=False)
    summaries = {key: rows.loc[[c.case_id for c in group]] for key, group in orders.items()}
    sheets = [
        losses({key: rows.loc[case.case_id] for key, case in crushes.items()}),
        rates({key: rows.loc[case.case_id] for key, case in at_rates.items()}),
        table(summaries),
        by_loss(summaries, "loss 40 %"),
        costs(),
    ]
    publish(sheets, folder / "memory.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
