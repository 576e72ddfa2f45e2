"""Crumple: which printed infill absorbs the most energy per gram?

A config defines a sweep; every combination of its grid is a case. `simulate` crushes one case and
returns a `Result`; `run_sweep` crushes all cases and stores the results in a file:

    import crumple

    config = crumple.load_config("smoke")  # an example, or the path of a file of your own
    case = crumple.expand(config)[0]
    result = crumple.simulate(case)
    print(result.status, result.summary["absorbed_energy_J"], result.history["reaction_top_N"])

    crumple.run_sweep(config, "results/smoke.h5")
    summary = crumple.read_summary("results/smoke.h5")  # a DataFrame: a row per case
    print(crumple.rank(summary, budget="2 g"))

Quantities are numbers in SI, or text with a unit. `crumple --help` explains the command line. Each
name is loaded when it is first used.
"""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sweep import *  # noqa: F403  (`sweep` has the only list of the names)
else:
    from sweep import __all__ as __all__
    from sweep import __dir__ as __dir__
    from sweep import __getattr__ as __getattr__


def main() -> int:
    """Run the command line: the program `crumple`."""
    from sweep.__main__ import main

    return main()


if __name__ == "__main__":
    sys.exit(main())
