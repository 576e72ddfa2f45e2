"""The network of springs, without bending and contact."""

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import first, history, report, run, varied

SHORT = {"duration": 0.03, "release_time": 0.03}


def bent():
    """The report's walls, which pass through one another."""
    return varied(report(), contact={"model": "none"}, loading=SHORT)


def loose():
    """The same walls without bending."""
    return varied(bent(), material={"bend": "none"})


def draw(folder):
    """Fig. 3 of the report: neither bending nor contact."""
    figure = case_plots.blank(10.0, 2.9)
    title = f"walls that stretch but do not bend or touch, {report().loading.force:g} N on top"
    case_plots.deformed_shapes(figure, title, run(loose()).frames, SHORT["duration"])
    case_plots.save(figure, folder / "fig03_springs.png")
    curves, stiff = history(loose()), history(bent())
    half, half_stiff = (first(past, past["strain"] > 0.5) for past in (curves, stiff))
    return (
        "A network of springs without bending and contact collapses in a way that no print does; "
        "this was the reason to add both.",
        f"A square of springs has no stiffness in shear: the strain exceeds 50 % after "
        f"{1e3 * half:.1f} ms, and at {1e3 * SHORT['duration']:.0f} ms the top row is "
        f"{100 * (curves['strain'].iloc[-1] - 1):.0f} % of the height below the bottom row, with "
        f"{run(loose()).summary['max_crossings']} crossings of walls. With the report's bending, "
        f"also without contact, the strain exceeds 50 % after {1e3 * half_stiff:.1f} ms.",
        "The mechanism is the same. The direction of folding follows the imperfection (a sideways "
        "bow of 1 % of the wall thickness), which the report does not state.",
    )
