"""The undeformed grid and its collapse, walls as thick as they are."""

from pathlib import Path

from sweep import plots
from sweep.figures.cases import ours, report, run, varied
from sweep.figures.springs import SHORT


def draw(folder: Path) -> tuple[str, ...]:
    """Its Figs. 5 and 6."""
    rest = run(report()).frames
    figure = plots.blank(3.0, 3.0)
    first = {
        **rest,
        **{key: rest[key][:1] for key in ("strain", "time_s", "position_m", "plate_y_m")},
    }
    plots.deformed_shapes(figure, "at rest", first)
    plots.save(figure, folder / "fig05_undeformed.png")
    cases = {
        "without contact": varied(report(), contact={"model": "none"}, loading=SHORT),
        "contact by position: the report's model": varied(report(), loading=SHORT),
        "barrier: our model": varied(ours(), loading=SHORT),
    }
    figure = plots.blank(10.0, 8.5)
    plots.winners(figure, {name: run(case).frames for name, case in cases.items()})
    plots.save(figure, folder / "fig06_collapse.png")
    rows = {name: run(case).summary for name, case in cases.items()}
    seen = "; ".join(
        f"{name}: strain up to {row['peak_strain']:.2f}, {row['max_crossings']} crossings of walls, "
        f"least distance of centre lines {_gap(row['min_gap_m'])}"
        for name, row in rows.items()
    )
    return (
        "Fig. 5 shows the grid of 3 x 3 cells with two nodes on each edge, Fig. 6 frames of its "
        "collapse under the load on the top row.",
        f"In the first {1e3 * SHORT['duration']:.0f} ms, {seen}. "
        f"The walls are {1e3 * report().lattice.wall_thickness:g} mm thick.",
        "Without a floor and without contact the top row ends below the bottom row. With contact "
        "the rows come to lie on one another, sideways, as the top row is free to sway.",
    )


def _gap(gap: float) -> str:
    return f"{1e3 * gap:.2f} mm" if gap == gap else "not watched"
