"""Force over displacement in cycles of growing amplitude: absorbed and returned energy."""

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import history, ours, run, varied
from tests.studies.panels import curves, legend, title

STRAINS = (0.6, 0.45, 0.3, 0.15)
PLATENS = {"glued": "glued platens", "contact": "loose platens"}


def draw(folder):
    """Loops between glued platens and between loose platens."""
    figure = case_plots.blank(10.0, 3.8)
    axes, measured = figure.subplots(1, 2, sharey=True), []
    for ax, (platen, words) in zip(axes, PLATENS.items(), strict=True):
        cases = {f"to {100 * strain:.0f} %": _crush(platen, strain) for strain in STRAINS}
        lines = {name: _loop(history(case)) for name, case in cases.items()}
        curves(ax, lines, "travel of the platen, mm", "force on the top, N")
        title(ax, f"{words}, friction {ours().contact.friction:g}")
        rows = [f"{name} {_energies(case)}" for name, case in cases.items()]
        measured.append(f"{words}: {', '.join(rows)}; {_losses(cases['to 60 %'])}")
    legend(axes[1])
    crushes = [_crush(platen, strain) for platen in PLATENS for strain in STRAINS]
    residual = max(abs(float(run(case).summary["residual_strain"])) for case in crushes)
    case_plots.save(figure, folder / "cycles.png")
    return (
        "The report loads by a force only; it proposes displacement control, reaction forces and "
        "cyclic loops.",
        f"Absorbed energy in loading and returned energy in unloading, in mJ. "
        f"{'. '.join(measured)}.",
        "Walls are elastic here: each loop follows the loading curve of the larger loops and "
        "returns nearly along it. At its end the lattice has its initial shape (residual strain: "
        f"at most {residual:.0e}), so that a second loop equals the first. The loss is friction. A "
        "print loses more energy, in the material itself, and softens.",
    )


def _crush(platen, strain):
    loading = {"mode": "displacement", "strain": strain, "platen": platen}
    return varied(ours(), loading=loading, solver={"load_steps": round(400 * strain)})


def _loop(past):
    return 1e3 * past["top_displacement_m"], past["reaction_top_N"]


def _energies(case):
    work = 1e3 * history(case)["work_in_J"]
    return f"{work.max():.1f} and {work.max() - work.iloc[-1]:.1f}"


def _losses(case):
    last = 1e3 * history(case).iloc[-1]
    return (
        f"in the largest loop friction dissipates {last['dissipated_friction_J']:.1f} and snaps "
        f"dissipate {abs(last['dissipated_integrator_J']):.1f}"
    )
