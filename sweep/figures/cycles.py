"""Force against displacement over cycles of growing amplitude: absorbed and returned energy."""

from pathlib import Path

from sweep import plots
from sweep.figures.cases import history, ours, run, varied
from sweep.figures.panels import curves, legend, title
from sweep.params import Case

STRAINS = (0.15, 0.3, 0.45, 0.6)
PLATENS = {"glued": "glued platens", "contact": "loose platens, friction 0.3"}


def draw(folder: Path) -> tuple[str, ...]:
    """Loops between glued and between loose platens."""
    figure = plots.blank(10.0, 3.8)
    said = []
    for ax, (platen, words) in zip(
        figure.subplots(1, 2, sharey=True), PLATENS.items(), strict=True
    ):
        loops = {f"to {100 * s:.0f} %": history(_crush(platen, s)) for s in STRAINS}
        lines = {
            name: (1e3 * past["top_displacement_m"], past["reaction_top_N"])
            for name, past in loops.items()
        }
        curves(ax, lines, "travel of the platen, mm", "force on the top, N")
        title(ax, words)
        rows = [run(_crush(platen, s)).summary for s in STRAINS]
        said.append(
            f"{words}: "
            + ", ".join(
                f"{100 * s:.0f} %: {1e3 * r['absorbed_energy_J']:.1f} and "
                f"{1e3 * r['returned_energy_J']:.1f} mJ"
                for s, r in zip(STRAINS, rows, strict=True)
            )
        )
    legend(ax)
    plots.save(figure, folder / "cycles.png")
    return (
        "The report loads by a force only; displacement control, reaction forces and cyclic loops "
        "are among its wishes.",
        f"Absorbed on the way down and returned on the way back, {'; '.join(said)}.",
        "Walls are elastic here: between glued platens a loop loses only what snaps between shapes "
        "set free, and a second loop is the first again. Friction on the platens opens the loops. "
        "A print loses more, in the material itself.",
    )


def _crush(platen: str, strain: float) -> Case:
    loading = {"mode": "displacement", "strain": strain, "platen": platen}
    return varied(ours(), loading=loading, solver={"load_steps": round(400 * strain)})
