"""Barrier and contact by position: errors of the energy for each time step."""

import numpy as np

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import at, converges, history, report, run, varied
from tests.studies.course_report.springs import SHORT
from tests.studies.panels import curves, legend, ticks, title

STEPS = (1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6)  # s
MODELS = ("position_based", "barrier")
HELD = SHORT["duration"]


def draw(folder):
    """Energy error over the time step."""
    position, barrier = _pasts("position_based"), _pasts("barrier")
    work = at(barrier[STEPS[-1]], "work_in_J", HELD)
    pushed = {
        dt: abs(at(past, "injected_by_projection_J", HELD)) / work for dt, past in position.items()
    }
    open_book = {
        dt: max(np.abs(past["energy_residual_J"]).max() / work, 1e-16)
        for dt, past in barrier.items()
    }
    figure = case_plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    errors = {"by position: injected": pushed, "barrier: residual": open_book}
    _curves(left, errors, "energy error / work done")
    title(left, "energy that no force accounts for")
    legend(left, loc="center left")
    stored = {"by position": _stored(position), "barrier": _stored(barrier)}
    _curves(right, stored, "stored energy, mJ")
    ticks(right.yaxis, (100, 200, 400, 800))
    title(right, f"stretching and bending after {1e3 * HELD:.0f} ms")
    legend(right, loc="upper left")
    case_plots.save(figure, folder / "contact_models.png")
    rows = "; ".join(
        f"{1e6 * dt:g} µs: {_words(pushed, dt)} and {open_book[dt]:.1e}" for dt in STEPS
    )
    order = np.log(pushed[STEPS[-2]] / pushed[STEPS[-1]]) / np.log(STEPS[-2] / STEPS[-1])
    crossed = [str(run(_case("position_based", dt)).summary["max_crossings"]) for dt in position]
    cost = [run(_case(model, STEPS[2])).summary["newton_iterations"] for model in MODELS]
    return (
        "The report moves walls apart after each step and names contact by forces as future work.",
        f"Energy error / work done, by position and by barrier: {rows}. Between the two finest "
        f"steps the injected energy falls with the power {order:.1f} of the step. At the finest, "
        f"{stored['by position'][STEPS[-1]]:.1f} and {stored['barrier'][STEPS[-1]]:.1f} mJ are "
        f"stored. Walls that cross, by position: {', '.join(crossed)}; with the barrier: "
        f"{max(run(_case('barrier', dt)).summary['max_crossings'] for dt in STEPS)}. "
        f"Newton iterations at {1e6 * STEPS[2]:g} µs: {cost[0]} and {cost[1]}.",
        "With contact by position, a wall that rests on another is moved back in every step, and "
        "the integrator removes the energy that this injects: the book closes only with the "
        "injected energy, which is many times the work done. The barrier is part of the energy "
        "that is minimised; the residual of its book is the tolerance of Newton's method.",
    )


def _pasts(model):
    """Curves by time step; by position, of the steps in which it runs to its end."""
    cases = {dt: _case(model, dt) for dt in STEPS}
    ended = [dt for dt in STEPS if model == "barrier" or converges(cases[dt])]
    return {dt: history(cases[dt]) for dt in ended}


def _stored(pasts):
    """Energy of stretching and bending by time step, mJ."""
    return {
        dt: 1e3 * (at(past, "stretch_J", HELD) + at(past, "bend_J", HELD))
        for dt, past in pasts.items()
    }


def _curves(ax, lines, y):
    """Values over time steps, each line by its label."""
    points = {label: (1e6 * np.array([*line]), [*line.values()]) for label, line in lines.items()}
    curves(ax, points, "time step, µs", y, marker="o")
    ax.set(xscale="log", yscale="log")
    ticks(ax.xaxis, 1e6 * np.array(STEPS))


def _words(values, dt):
    return f"{values[dt]:.3g}" if dt in values else "stopped"


def _case(model, dt):
    frictionless = {} if model == "position_based" else {"friction": 0.0}
    return varied(report(), contact={"model": model, **frictionless}, loading=SHORT,
                  solver={"time_step": dt})  # fmt: skip
