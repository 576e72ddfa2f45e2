"""Barrier and contact by position: errors of the energy for each time step."""

import numpy as np

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import at, history, report, run, varied
from tests.studies.course_report.springs import SHORT
from tests.studies.panels import curves, legend, ticks, title

STEPS = (1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6)  # s
MODELS = {"position_based": "by position", "barrier": "barrier"}
HELD = SHORT["duration"]


def draw(folder):
    """Energy error over the time step."""
    pasts = {words: [history(_case(model, dt)) for dt in STEPS] for model, words in MODELS.items()}
    work = at(pasts["barrier"][-1], "work_in_J", HELD)
    pushed = [
        abs(at(past, "injected_by_projection_J", HELD)) / work for past in pasts["by position"]
    ]
    open_book = [
        max(np.abs(past["energy_residual_J"]).max() / work, 1e-16) for past in pasts["barrier"]
    ]
    figure = case_plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    steps = 1e6 * np.array(STEPS)
    lines = {"by position: injected": (steps, pushed), "barrier: residual": (steps, open_book)}
    curves(left, lines, "time step, µs", "energy error / work done", marker="o")
    left.set(xscale="log", yscale="log")
    title(left, "energy that no force accounts for")
    legend(left, loc="center left")
    stored = {
        words: [1e3 * (at(p, "stretch_J", HELD) + at(p, "bend_J", HELD)) for p in runs]
        for words, runs in pasts.items()
    }
    curves(right, {n: (steps, e) for n, e in stored.items()}, "time step, µs", "stored energy, mJ",
           marker="o")  # fmt: skip
    right.set(xscale="log", yscale="log")
    for ax in (left, right):
        ticks(ax.xaxis, steps)
    ticks(right.yaxis, (100, 200, 400, 800))
    title(right, f"stretching and bending after {1e3 * HELD:.0f} ms")
    legend(right, loc="upper left")
    case_plots.save(figure, folder / "contact_models.png")
    rows = "; ".join(
        f"{dt:g} µs: {p:.3g} and {o:.1e}" for dt, p, o in zip(steps, pushed, open_book, strict=True)
    )
    order = np.log(pushed[-2] / pushed[-1]) / np.log(STEPS[-2] / STEPS[-1])
    last = {name: values[-1] for name, values in stored.items()}
    crossed = [run(_case("position_based", dt)).summary["max_crossings"] for dt in STEPS]
    cost = [run(_case(model, STEPS[2])).summary["newton_iterations"] for model in MODELS]
    return (
        "The report moves walls apart after each step and names contact by forces as future work.",
        f"Energy error / work done, by position and by barrier: {rows}. Between the two finest "
        f"steps the injected energy falls with the power {order:.1f} of the step. At the finest, "
        f"{last['by position']:.1f} and {last['barrier']:.1f} mJ are stored. Walls that cross, by "
        f"position: {', '.join(map(str, crossed))}; with the barrier: "
        f"{max(run(_case('barrier', dt)).summary['max_crossings'] for dt in STEPS)}. "
        f"Newton iterations at {steps[2]:g} µs: {cost[0]} and {cost[1]}.",
        "With contact by position, a wall that rests on another is moved back in every step, and "
        "the integrator removes the energy that this injects: the book closes only with the "
        "injected energy, which is many times the work done. The barrier is part of the energy "
        "that is minimised; the residual of its book is the tolerance of Newton's method.",
    )


def _case(model, dt):
    frictionless = {} if model == "position_based" else {"friction": 0.0}
    return varied(report(), contact={"model": model, **frictionless}, loading=SHORT,
                  solver={"time_step": dt})  # fmt: skip
