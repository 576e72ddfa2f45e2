"""The undeformed grid and its collapse, with walls of their true thickness."""

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import ours, report, run, varied
from tests.studies.course_report.springs import SHORT


def draw(folder):
    """Figs. 5 and 6 of the report."""
    frames = run(report()).frames
    rest = {key: values[:1] for key, values in frames.items() if not key.startswith("edge")}
    figure = case_plots.blank(3.0, 3.2)
    case_plots.deformed_shapes(figure, "at rest", {**frames, **rest})
    case_plots.save(figure, folder / "fig05_undeformed.png")
    by_position, barrier = varied(report(), loading=SHORT), varied(ours(), loading=SHORT)
    cases = {
        "without contact": varied(report(), contact={"model": "none"}, loading=SHORT),
        "contact by position: the report's model": by_position,
        "barrier: our model": barrier,
    }
    figure = case_plots.blank(10.0, 7.0)
    strips = figure.subfigures(len(cases), 1, squeeze=False)[:, 0]
    for strip, (name, case) in zip(strips, cases.items(), strict=True):
        case_plots.deformed_shapes(strip, name, run(case).frames, SHORT["duration"])
    case_plots.save(figure, folder / "fig06_collapse.png")
    rows = [
        f"{name}: strain up to {run(case).summary['peak_strain']:.2f}, "
        f"{run(case).summary['max_crossings']} crossings of walls"
        for name, case in cases.items()
    ]
    return (
        "Fig. 5 shows the grid of 3 x 3 cells with two nodes on each edge, Fig. 6 frames of its "
        "collapse under the load on the top row.",
        f"In the first {1e3 * SHORT['duration']:.0f} ms, {'; '.join(rows)}. The walls are "
        f"{1e3 * report().lattice.wall_thickness:g} mm thick; the least distance of centre lines "
        f"is {_gap(by_position):.2f} mm with contact by position and {_gap(barrier):.2f} mm with "
        "the barrier.",
        "Without a floor and without contact the top row ends below the bottom row. With contact "
        "the rows lie on one another, shifted sideways, as the top row is free to sway. Only the "
        "bottom row is held: the grey bar marks it, and is no floor.",
    )


def _gap(case):
    """Least distance of centre lines, mm."""
    return 1e3 * float(run(case).summary["min_gap_m"])
