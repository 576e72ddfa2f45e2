"""Vertical strain of the top row against time."""

from pathlib import Path

from sweep import plots
from sweep.figures.cases import HELD, at, history, ours, report, run, varied
from sweep.figures.panels import curves, legend, title

BUCKLED = 0.05  # strain that no standing lattice reaches


def draw(folder: Path) -> tuple[str, ...]:
    """Its Fig. 7: buckling, rows landing on one another, release."""
    barrier = varied(report(), contact={"model": "barrier"})
    cases = {"the report's model": report(), "with the barrier": barrier, "our model": ours()}
    pasts = {name: history(case) for name, case in cases.items()}
    figure = plots.blank(9.0, 6.0)
    whole, start = figure.subplots(2, 1)
    for ax, until in ((whole, 0.2), (start, 0.03)):
        lines = {
            name: (1e3 * past["time_s"][past["time_s"] <= until], 100 * past["strain"])
            for name, past in pasts.items()
        }
        curves(
            ax, {name: (t, s[: len(t)]) for name, (t, s) in lines.items()}, "time, ms", "strain, %"
        )
    plots.mark(whole, 1e3 * float(report().loading.release_time or 0.0), "load off")
    title(whole, f"{report().loading.force:g} N on the top row, put on at once")
    title(start, "the first 30 ms")
    past = pasts["the report's model"]
    buckled = past["time_s"][(past["strain"] > BUCKLED).idxmax()]
    landed = past["time_s"][(past["injected_by_projection_J"] != 0.0).idxmax()]
    plots.mark(start, 1e3 * buckled, "buckles")
    plots.mark(start, 1e3 * landed, "walls meet")
    legend(whole)
    plots.save(figure, folder / "fig07_strain.png")
    held = ", ".join(f"{100 * at(past, 'strain'):.1f} % ({name})" for name, past in pasts.items())
    rests = ", ".join(f"{run(c).summary['residual_strain']:.3f} ({n})" for n, c in cases.items())
    return (
        "Fig. 7 shows the strain of the top row: buckling, rows that land on one another, and the "
        "recovery after the release at 138 ms.",
        f"The report's model passes {100 * BUCKLED:.0f} % after {1e3 * buckled:.1f} ms and its walls "
        f"meet first at {1e3 * landed:.1f} ms. At {1e3 * HELD:.0f} ms the strain is {held}. Strain "
        f"left at the end: {rests}.",
        "The phases are the same. The models stop at other strains: classical hinges are softer, "
        "the tangent measure stiffens sharp folds, and ours rubs (friction "
        f"{ours().contact.friction:g}) where the report's has none.",
    )
