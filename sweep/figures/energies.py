"""Energies against time, and how many times the stretching energy bending stores."""

from pathlib import Path

from sweep import plots
from sweep.figures.cases import HELD, at, history, ours, report, run, share, varied
from sweep.figures.panels import curves, legend, title

STEPS = (1e-4, 5e-5, 2e-5, 1e-5)  # s
SHOWN = {
    "bend_J": "bending",
    "stretch_J": "stretching",
    "kinetic_J": "motion",
    "contact_J": "contact",
}


def draw(folder: Path) -> tuple[str, ...]:
    """Its Fig. 8."""
    pasts = {"the report's model": history(report()), "our model": history(ours())}
    figure = plots.blank(9.0, 6.0)
    for ax, (name, past) in zip(
        figure.subplots(2, 1, sharex=True, sharey=True), pasts.items(), strict=True
    ):
        lines = {label: (1e3 * past["time_s"], 1e3 * past[key]) for key, label in SHOWN.items()}
        curves(ax, lines, "time, ms", "energy, mJ")
        plots.mark(ax, 1e3 * float(report().loading.release_time or 0.0), "load off")
        title(ax, name)
        legend(ax)
    plots.save(figure, folder / "fig08_energies.png")
    ratios = {}
    for step in STEPS:
        result = run(varied(report(), solver={"time_step": step}))
        ratios[step] = share(history(varied(report(), solver={"time_step": step})))
        if result.status != "converged":
            ratios[step] = float("nan")
    by_step = ", ".join(
        f"{ratio:.1f} at {1e6 * step:g} us" if ratio == ratio else f"stopped at {1e6 * step:g} us"
        for step, ratio in ratios.items()
    )
    standing = history(varied(ours(), loading={"force": 12.0}))
    mine, theirs = pasts["our model"], pasts["the report's model"]
    return (
        "Fig. 8 shows the energies; bending comes to nearly twice stretching.",
        f"At {1e3 * HELD:.0f} ms bending is {share(theirs):.1f} times stretching in the report's "
        f"model ({1e3 * at(theirs, 'bend_J'):.0f} and {1e3 * at(theirs, 'stretch_J'):.0f} mJ) and "
        f"{share(mine):.1f} times in ours ({1e3 * at(mine, 'bend_J'):.0f} and "
        f"{1e3 * at(mine, 'stretch_J'):.1f} mJ). In the report's model the ratio depends on the time "
        f"step: {by_step}. Under 12 N, just before it gives way, ours stands with a ratio of "
        f"{share(standing):.1f}.",
        "A collapsed lattice of thin walls bends and hardly stretches. Contact by position moves "
        "single nodes against the stiff springs on both sides, in every step: it stores stretching "
        "energy that no contact force needs, the more so the longer the step. A ratio near two is "
        "what that gives at long steps, or what a lattice has that is about to buckle.",
    )
