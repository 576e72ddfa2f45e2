"""The network of springs alone."""

from pathlib import Path

from sweep.report import case_plots
from sweep.studies.course_report.cases import history, report, run, varied

SHORT = {"duration": 0.03, "release_time": 0.03}


def draw(folder: Path) -> tuple[str, ...]:
    """Its Fig. 3: neither bending nor contact."""
    bent = varied(report(), contact={"model": "none"}, loading=SHORT)
    loose = varied(bent, material={"bend": "none"})
    figure = case_plots.blank(10.0, 2.9)
    title = f"walls that stretch but do not bend or touch, {report().loading.force:g} N on top"
    case_plots.deformed_shapes(figure, title, run(loose).frames, SHORT["duration"])
    case_plots.save(figure, folder / "fig03_springs.png")
    curves, stiff = history(loose), history(bent)
    falls, sinks = (past["time_s"][(past["strain"] > 0.5).idxmax()] for past in (curves, stiff))
    return (
        "A network of springs alone, without bending and without contact, collapses in a way that "
        "no print does; this motivated both.",
        f"Nothing holds a square of springs upright: half of the height is gone after "
        f"{1e3 * falls:.1f} ms, and at {1e3 * SHORT['duration']:.0f} ms the top row hangs "
        f"{100 * (curves['strain'].iloc[-1] - 1):.0f} % of the height below the bottom row, walls "
        f"through one another {run(loose).summary['max_crossings']} times. With the report's "
        f"bending, also without contact, half of it is gone after {1e3 * sinks:.1f} ms.",
        "Same mechanism. The way it folds follows the imperfection (a sideways bow of 1 % of the "
        "wall thickness), of which the report says nothing.",
    )
