"""Vertical strain of the top row over time."""

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import (
    HELD,
    at,
    coarse,
    first,
    history,
    ours,
    report,
    run,
    varied,
)
from tests.studies.panels import curves, legend, title

BUCKLED = 0.05  # strain above which a lattice has buckled


def draw(folder):
    """Fig. 7 of the report: buckling, first contact of rows, release."""
    barrier = varied(report(), contact={"model": "barrier"})
    cases = {"the report's model": report(), "with the barrier": barrier, "our model": ours()}
    pasts = {name: history(case) for name, case in cases.items()}
    figure = case_plots.blank(9.0, 6.0)
    whole, start = figure.subplots(2, 1)
    for ax, until in ((whole, 0.2), (start, 0.02)):
        lines = {
            name: (1e3 * past["time_s"][past["time_s"] <= until], 100 * past["strain"])
            for name, past in pasts.items()
        }
        curves(
            ax, {name: (t, s[: len(t)]) for name, (t, s) in lines.items()}, "time, ms", "strain, %"
        )
    case_plots.mark(whole, 1e3 * float(report().loading.release_time or 0.0), "load off")
    title(whole, f"{report().loading.force:g} N on the top row, applied at once")
    title(start, "the first 20 ms")
    past = pasts["the report's model"]
    buckled = first(past, past["strain"] > BUCKLED)
    landed = first(past, past["injected_by_projection_J"] != 0.0)
    case_plots.mark(start, 1e3 * buckled, "buckles")
    case_plots.mark(start, 1e3 * landed, "walls\nmeet")
    legend(whole)
    case_plots.save(figure, folder / "fig07_strain.png")
    held = ", ".join(f"{100 * at(past, 'strain'):.1f} % ({name})" for name, past in pasts.items())
    rests = max(abs(float(run(case).summary["residual_strain"])) for case in cases.values())
    fine = history(varied(coarse(), lattice={"nodes_per_wall": 8}))
    return (
        "Fig. 7 shows the strain of the top row: buckling, rows that touch one another, and the "
        "recovery after the release at 138 ms.",
        f"In the report's model the strain exceeds {100 * BUCKLED:.0f} % after "
        f"{1e3 * buckled:.1f} ms, and walls first touch at {1e3 * landed:.1f} ms. At "
        f"{1e3 * HELD:.0f} ms the strain is {held}. "
        f"At the end all models are back at rest, to within a strain of {rests:.1e}.",
        "The phases are the same. Classical elements are softer and buckle earlier. The strain "
        "under the load depends on sharp folds, which the tangent measure stiffens; contact by "
        "position carries less load than the barrier. Three elements per wall do not resolve these "
        "folds: "
        f"with nine, the strain of our model is {100 * at(fine, 'strain'):.1f} %.",
    )
