"""Force against displacement over cycles of growing amplitude: absorbed and returned energy."""

from pathlib import Path

from pandas import DataFrame

from sweep.config.case import Case
from sweep.report import case_plots
from sweep.studies.course_report.cases import history, ours, run, varied
from sweep.studies.course_report.panels import curves, legend, title

STRAINS = (0.6, 0.45, 0.3, 0.15)
PLATENS = {"glued": "glued platens", "contact": "loose platens"}


def draw(folder: Path) -> tuple[str, ...]:
    """Loops between glued and between loose platens."""
    figure = case_plots.blank(10.0, 3.8)
    axes, said = figure.subplots(1, 2, sharey=True), []
    for ax, (platen, words) in zip(axes, PLATENS.items(), strict=True):
        cases = {f"to {100 * strain:.0f} %": _crush(platen, strain) for strain in STRAINS}
        lines = {name: _loop(history(case)) for name, case in cases.items()}
        curves(ax, lines, "travel of the platen, mm", "force on the top, N")
        title(ax, f"{words}, friction {ours().contact.friction:g}")
        rows = [f"{name} {_worth(case)}" for name, case in cases.items()]
        said.append(f"{words}: {', '.join(rows)}; {_lost(cases['to 60 %'])}")
    legend(axes[1])
    left = max(_left(_crush(platen, strain)) for platen in PLATENS for strain in STRAINS)
    case_plots.save(figure, folder / "cycles.png")
    return (
        "The report loads by a force only; displacement control, reaction forces and cyclic loops "
        "are among its wishes.",
        f"Absorbed on the way down and returned on the way back, in mJ. {'. '.join(said)}.",
        "Walls are elastic here: each loop goes up the curve of the greater ones and nearly back "
        f"along it, and at its end the lattice is as it was (strain left: at most {left:.0e}), so "
        "that a second loop is the first again. What it loses is friction. A print loses more, in "
        "the material itself, and softens.",
    )


def _crush(platen: str, strain: float) -> Case:
    loading = {"mode": "displacement", "strain": strain, "platen": platen}
    return varied(ours(), loading=loading, solver={"load_steps": round(400 * strain)})


def _loop(past: DataFrame) -> tuple[DataFrame, DataFrame]:
    return 1e3 * past["top_displacement_m"], past["reaction_top_N"]


def _worth(case: Case) -> str:
    work = 1e3 * history(case)["work_in_J"]
    return f"{work.max():.1f} and {work.max() - work.iloc[-1]:.1f}"


def _lost(case: Case) -> str:
    last = 1e3 * history(case).iloc[-1]
    return (
        f"of the greatest loop friction takes {last['dissipated_friction_J']:.1f} and snaps take "
        f"{abs(last['dissipated_integrator_J']):.1f}"
    )


def _left(case: Case) -> float:
    return abs(float(run(case).summary["residual_strain"]))
