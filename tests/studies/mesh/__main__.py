"""How many elements a wall needs: every column of a ranking against a converged mesh.

Run by `make mesh`: all infills, light and heavy, glued and loose, crushed to 60 % with one element
per wall and with more, up to `FINEST`; the last is the reference. Where the two finest meshes
follow different paths there is no reference: such designs are marked and enter no average. The same
crushes without contact show how many elements bending alone needs; the order of the designs of the
shipped sweeps is compared with their order on a fine mesh. Finished cases are kept in the given
folder.
"""

import sys
from pathlib import Path

from sweep.running.beside.error_bars import companions
from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.mesh.certainty import covered
from tests.studies.mesh.crushes import cases_of, compare, curve, usual, without_contact
from tests.studies.mesh.orders import by_order, finer
from tests.studies.mesh.tables import by_column, by_design, by_group
from tests.studies.rankings.orders import cases_of as cases_of_sweeps
from tests.studies.tables import publish

CONFIGS = Path(__file__).parents[3] / "configs"


def main(folder):
    """Run the missing cases, and print the tables."""
    folder.mkdir(parents=True, exist_ok=True)
    file, cases = folder / "mesh.h5", cases_of()
    bending = without_contact(cases)
    ranked = [case for (design, n), case in cases.items() if n == usual(design)]
    others = [companion.case for case in ranked for companion in companions(case)]
    crushes = [*cases.values(), *bending.values()]
    shipped = cases_of_sweeps(CONFIGS)
    fine = {name: [finer(case) for case in group] for name, group in shipped.items()}
    others += [case for table in (shipped, fine) for group in table.values() for case in group]
    run_sweep(list({case.case_id: case for case in (*crushes, *others)}.values()), file)
    rows = read_summary(file).set_index("case_id")
    curves = {case.case_id: curve(file, case.case_id) for case in crushes}
    found = compare(cases, rows, curves)
    alone = by_column(compare(bending, rows, curves), "Errors by column, glued, without contact")
    sheets = [by_column(found), alone, by_group(found), by_design(found), covered(cases, rows)]
    tables = (
        {name: rows.loc[[case.case_id for case in group]] for name, group in table.items()}
        for table in (shipped, fine)
    )
    sheets.append(by_order(*tables))
    publish(sheets, folder / "mesh.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
