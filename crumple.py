"""Crumple: which printed infill absorbs the most energy per gram?

A config defines a sweep; every combination of its grid is a case. `simulate` crushes one case and
returns a `Result`; `run` crushes all cases, stores the results in a file and returns them:

    import crumple

    case = crumple.case(lattice={"kind": "hex", "width": "25 mm"}, loading={"force": "20 N"})
    result = crumple.simulate(case)
    print(result.status, result.summary["absorbed_energy_J"], result.history["reaction_top_N"])

    results = crumple.run("smoke")  # an example, a file of your own, or a dict of its tables
    results  # a notebook shows the ranking; it is in results/smoke.h5
    print(results.table, results.curve(0))  # DataFrames: a row per case, a row per step
    print(results.rank(budget="2 g"))  # crumple.rank for any results file
    results.plot(0).save("force.png")  # a notebook shows results.plot(0), results.plot()
    results.report()  # one page with sliders, results/smoke.html
    results = crumple.Results("results/smoke.h5")  # the same again, later

`optimize` searches, `spread` runs the best designs again at the ends of uncertain numbers,
`materials` has the materials as a table, `card` the infill of a case as a material. In tables,
units are in the names of columns; in `Case` and its parts numbers are in SI. Configs and rankings
take text with units. `crumple --help` explains the command line. Each name is loaded when it is
first used.
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
