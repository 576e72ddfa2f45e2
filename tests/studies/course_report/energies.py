"""Energies over time, and the ratio of bending energy to stretching energy."""

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import (
    HELD,
    at,
    converges,
    history,
    ours,
    report,
    share,
    varied,
)
from tests.studies.panels import curves, legend, title

STANDING = 12.0  # N
STEPS = (1e-4, 5e-5, 2e-5, 1e-5)  # s
SHOWN = {
    "bend_J": "bending",
    "stretch_J": "stretching",
    "kinetic_J": "motion",
    "contact_J": "contact",
}


def draw(folder):
    """Fig. 8 of the report."""
    pasts = {"the report's model": history(report()), "our model": history(ours())}
    figure = case_plots.blank(9.0, 6.0)
    for ax, (name, past) in zip(
        figure.subplots(2, 1, sharex=True, sharey=True), pasts.items(), strict=True
    ):
        lines = {
            label: (1e3 * past["time_s"], 1e3 * past[key])
            for key, label in SHOWN.items()
            if past[key].any()
        }
        curves(ax, lines, "time, ms", "energy, mJ")
        case_plots.mark(ax, 1e3 * float(report().loading.release_time or 0.0), "load off")
        title(ax, name)
        legend(ax)
    case_plots.save(figure, folder / "fig08_energies.png")
    by_step = ", ".join(f"{_ratio(step)} at {1e6 * step:g} µs" for step in STEPS)
    standing = varied(ours(), loading={"force": STANDING})
    mine, theirs = pasts["our model"], pasts["the report's model"]
    return (
        "Fig. 8 shows the energies; the bending energy is nearly twice the stretching energy.",
        f"At {1e3 * HELD:.0f} ms bending is {share(theirs):.1f} times stretching in the report's "
        f"model ({_both(theirs)}) and {share(mine):.1f} times in ours ({_both(mine)}). In the "
        f"report's model the ratio depends on the time step: {by_step}. Under {STANDING:g} N, just "
        f"below buckling, our lattice has a ratio of {share(history(standing)):.1f}.",
        "A collapsed lattice of thin walls bends and hardly stretches. In every step, contact by "
        "position moves single nodes against the stiff springs on both sides: it stores stretching "
        "energy that no contact force requires, and more of it in longer steps. A ratio near two "
        "results from long steps, or from a lattice that is about to buckle.",
    )


def _ratio(step):
    case = varied(report(), solver={"time_step": step})
    return f"{share(history(case)):.1f}" if converges(case) else "stopped"


def _both(past):
    return f"{1e3 * at(past, 'bend_J'):.0f} and {1e3 * at(past, 'stretch_J'):.0f} mJ"
