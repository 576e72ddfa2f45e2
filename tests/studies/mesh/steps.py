"""How long load steps may be: ranked values in steps of an accuracy and in equal ones.

Run by `make steps`: the crushes of `crushes` on their default meshes, elastic and with a loss of 40
%, against the finest of `EQUAL` steps. Designs that follow different paths in its two numbers of
steps enter no average. Iterations are counted by phase, too, between glued platens. Finished cases
are kept in the given folder.
"""

import sys
from pathlib import Path

import numpy as np

from sweep.loading_modes import MODES
from sweep.report.tables.sheet import Sheet
from sweep.running.sweep import run_sweep
from sweep.store.read import read_history, read_summary
from tests.studies.mesh.crushes import COLUMNS, DESIGNS, curve, parted, usual
from tests.studies.rankings.spread import crush, nine_of_ten
from tests.studies.tables import publish

SETTINGS = {
    **{f"{share:.1%}": {"accuracy": share} for share in (1e-2, 3e-3, 1e-3)},
    **{str(count): {"load_steps": count} for count in (25, 50, 100, 200, 400)},
}
LOSSES = (0.0, 0.4)
PHASES = ("before buckling", "on the plateau", "in contact", "beyond densification")
UNIT = 3e-3  # strain of one of 200 equal steps
BUCKLED = 0.5  # share of the first stiffness, below which a wall has buckled
TOUCHED = 1e-6  # share of the work, stored in contacts
TRUE = "0.1%"  # setting whose phases count
EQUAL = {0.0: ("800", "1600"), 0.4: ("6400", "12800")}  # by loss: a fine and the finest number


def cases_of(designs=DESIGNS, settings=SETTINGS, losses=LOSSES):
    """The crushes by loss, design and setting."""
    return {
        (loss, design, name): _case(design, loss, setting)
        for loss in losses
        for design in designs
        for name, setting in (settings | _equal(loss)).items()
    }


def _equal(loss):
    return {text: {"load_steps": int(text)} for text in EQUAL[loss]}


def _case(design, loss, setting):
    case = crush(design, usual(design), imperfection=0.01, steps=200)
    solver = {"accuracy": None, "load_steps": None} | setting
    return case.changed(solver=solver, **({"material": {"loss": loss}} if loss else {}))


def compare(cases, rows, curves, loss):
    """Errors of each setting against the finest: setting -> column -> (designs,); and iterations.

    rows: the summary by case id. curves: case id -> (strain, work). The errors of a design are NaN
    if it failed, or has no reference.
    """
    designs = list(dict.fromkeys(design for each, design, _ in cases if each == loss))
    settings = list(dict.fromkeys(name for each, _, name in cases if each == loss))
    fine, finest = EQUAL[loss]
    kept = (*COLUMNS, "parted", "work", "estimate")
    errors = {name: {column: [] for column in kept} for name in settings}
    for design in designs:
        ids = {name: cases[loss, design, name].case_id for name in settings}
        true, path = rows.loc[ids[finest]], curves[ids[finest]]
        certain = all(rows.loc[ids[name], "status"] == "converged" for name in (fine, finest))
        certain = certain and np.isnan(parted(curves[ids[fine]], path))
        for name, case_id in ids.items():
            row, known = rows.loc[case_id], errors[name]
            counts = certain and row["status"] == "converged"
            for column in COLUMNS:
                known[column].append(abs(row[column] / true[column] - 1.0) if counts else np.nan)
            known["parted"].append(parted(curves[case_id], path) if counts else np.nan)
            known["work"].append(row["newton_iterations"])
            known["estimate"].append(row["load_step_error"])
    return errors


def sheet(errors, loss):
    """Errors in %, the median / the ninth decile / the greatest, and iterations."""
    fine, finest = EQUAL[loss]
    names = [name for name in errors if name not in EQUAL[loss]]
    rows = [
        [text, *(_errors(errors[name][column]) for name in names)]
        for column, text in COLUMNS.items()
    ]
    rows.append(["energy, not marked", *(_errors(_unmarked(errors[name])) for name in names)])
    rows.append(["marked", *(str(int(_marked(errors[name]).sum())) for name in names)])
    rows.append(["paths part", *(str(np.isfinite(errors[name]["parted"]).sum()) for name in names)])
    rows.append(["iterations", *(f"{np.median(errors[name]['work']):.0f}" for name in names)])
    entering = int(np.isfinite(errors[fine]["absorbed_energy_J"]).sum())
    notes = (
        f"Errors in %, beside {finest} equal steps: the middle one / that of nine of ten / the "
        "greatest. Accuracies in %, numbers of equal steps.",
        f"{entering} of {len(errors[fine]['work'])} designs enter; the others have no truth.",
    )
    material = "elastic" if loss == 0.0 else f"loss {loss:.0%}"
    return Sheet(f"Errors of load steps, {material}", ["steps", *names], rows, notes=notes)


def _marked(error):
    """Whether a ranking marks each crush, by the estimated error of its steps."""
    return np.array(error["estimate"]) > MODES["displacement"].coarse[0].most


def _unmarked(error):
    """Errors of the energy of crushes without a mark; NaN for the others."""
    return np.where(_marked(error), np.nan, error["absorbed_energy_J"])


def _errors(values):
    known = np.array(values)[np.isfinite(values)]
    if not known.size:
        return "–"
    return " / ".join(
        f"{100.0 * error:.2g}" for error in (np.median(known), nine_of_ten(known), known.max())
    )


def begun(history, densified):
    """Strains at which the phases of a crush begin, NaN for one that it does not have.

    densified: densification strain, NaN if none.
    """
    strain, force, work = (history[name] for name in ("strain", "reaction_top_N", "work_in_J"))
    buckled = force < BUCKLED * force[1] / strain[1] * strain
    touched = history["contact_J"] > TOUCHED * work
    return np.array([0.0, strain[buckled].min(), strain[touched].min(), densified])


def by_phase(history, begins):
    """Iterations for each `UNIT` of strain in the phases that begin at these strains; NaN if a
    crush does not have a phase, or one is no longer than that.
    """
    strain = history["strain"]
    ends = [np.fmin.reduce([*begins[k + 1 :], strain.iloc[-1]]) for k in range(len(PHASES))]
    spent = history["newton_iterations"].cumsum()
    at_start, at_end = (np.interp(places, strain, spent) for places in (begins, ends))
    span = (ends - begins) / UNIT
    return np.where(span > 1.0, (at_end - at_start) / np.where(span > 1.0, span, 1.0), np.nan)


def phase_sheet(iterations):
    """Medians over crushes: setting -> iterations (crushes, phases); the phases are the same."""
    every = {name: np.array(each) for name, each in iterations.items()}
    crushes = np.isfinite(next(iter(every.values()))).sum(axis=0)
    medians = [np.nanmedian(each, axis=0) for each in every.values()]
    rows = [
        [phase, str(crushes[k]), *(f"{each[k]:.2g}" for each in medians)]
        for k, phase in enumerate(PHASES)
    ]
    title = f"Iterations for each {UNIT:.1%} of strain, glued platens, elastic"
    note = f"Phases are those of the steps of an accuracy of {TRUE}."
    return Sheet(title, ["phase", "crushes", *every], rows, notes=(note,))


def phases(file, cases, rows):
    """What `phase_sheet` shows, of the crushes that converge in all settings."""
    iterations = {name: [] for name in SETTINGS}
    for design in (each for each in DESIGNS if each[1][0] == "glued"):
        ids = {name: cases[0.0, design, name].case_id for name in SETTINGS}
        if (rows.loc[[*ids.values()], "status"] != "converged").any():
            continue
        densified = rows.loc[ids[TRUE], "densification_strain"]
        begins = begun(read_history(file, ids[TRUE]), densified)
        for name, case_id in ids.items():
            iterations[name].append(by_phase(read_history(file, case_id), begins))
    return iterations


def main(folder):
    """Run the missing cases, and print the tables."""
    folder.mkdir(parents=True, exist_ok=True)
    file, cases = folder / "steps.h5", cases_of()
    run_sweep(list({case.case_id: case for case in cases.values()}.values()), file)
    rows = read_summary(file).set_index("case_id")
    curves = {case.case_id: curve(file, case.case_id) for case in cases.values()}
    sheets = [sheet(compare(cases, rows, curves, loss), loss) for loss in LOSSES]
    publish([*sheets, phase_sheet(phases(file, cases, rows))], folder / "steps.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
