"""Crumple: which printed infill absorbs the most energy per gram?

A config defines a sweep; every combination of its grid is a case. `simulate` crushes one case and
returns a `Result`; `run` crushes all cases, stores the results in a file and returns them:

    import crumple

    config = crumple.load_config("smoke")  # an example, or the path of a file of your own
    case = crumple.expand(config)[0]
    result = crumple.simulate(case)
    print(result.status, result.summary["absorbed_energy_J"], result.history["reaction_top_N"])

    results = crumple.run(config)  # in results/smoke.h5; run_sweep does no more than write
    print(results.table, results.curve(0))  # DataFrames: a row per case, a row per step
    print(results.rank(budget="2 g"))  # crumple.rank for any results file
    results.plot(0).save("force.png")  # a notebook shows results.plot(0), results.plot()
    results = crumple.Results("results/smoke.h5")  # the same again, later

In tables, units are in the names of columns; in `Case` and its parts numbers are in SI. A ranking
takes text with units. `crumple --help` explains the command line. Each
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
