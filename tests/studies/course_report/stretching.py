"""Linear against nonlinear stretching, under force and under displacement."""

import numpy as np

from sweep.report.figures import case_plots
from tests.studies.course_report.cases import HELD, at, history, ours, report, varied
from tests.studies.panels import curves, legend, title

LAWS = ("nonlinear", "linear")
PRESSED = {"mode": "displacement", "strain": 0.6, "unload": False, "platen": "glued"}


def draw(folder):
    """Figs. 9 and 10 of the report."""
    forced, pressed = _pair(report()), _pair(varied(ours(), loading=PRESSED))
    steady = _pair(ours())
    figure = case_plots.blank(9.0, 3.4)
    ax = figure.subplots()
    lines = {f"{law}, the report's model": _strain(past) for law, past in forced.items()}
    curves(ax, lines | {f"{law}, our model": _strain(past) for law, past in steady.items()},
           "time, ms", "strain, %")  # fmt: skip
    legend(ax)
    case_plots.save(figure, folder / "fig09_stretching_strain.png")
    figure = case_plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    for ax, pasts, x in ((left, forced, "time_s"), (right, pressed, "strain")):
        factor, words = (1e3, "time, ms") if x == "time_s" else (100.0, "strain, %")
        lines = {
            f"{label}, {law}": (factor * past[x], 1e3 * past[key])
            for key, label in (("bend_J", "bending"), ("stretch_J", "stretching"))
            for law, past in pasts.items()
        }
        curves(ax, lines, words, "energy, mJ")
    title(left, f"under a force of {report().loading.force:g} N, the report's model")
    title(right, "under displacement, our model")
    legend(right)
    case_plots.save(figure, folder / "fig10_stretching_energies.png")
    bend_at_rest = _at_rest(steady, "bend_J")
    bend_driven = _greatest(pressed, "bend_J", "strain")
    return (
        "Figs. 9 and 10 compare linear and nonlinear stretching under a force; the report expected "
        "them to diverge more under displacement.",
        f"Greatest differences / greatest value. Under the force, the report's model: "
        f"{_words(forced, 'time_s')}; ours: {_words(steady, 'time_s')}. At rest under the force, "
        f"at {1e3 * HELD:.0f} ms: strain "
        f"{_at_rest(forced, 'strain'):.1f} %, bending {_at_rest(forced, 'bend_J'):.1f} % and "
        f"stretching {_at_rest(forced, 'stretch_J'):.1f} % in the report's model; "
        f"{_at_rest(steady, 'strain'):.1f} %, {bend_at_rest:.1f} % and "
        f"{_at_rest(steady, 'stretch_J'):.1f} % in ours. Our model pressed to 60 % "
        f"between glued platens: {_words(pressed, 'strain')}, force on the top "
        f"{_greatest(pressed, 'reaction_top_N', 'strain'):.1f} %.",
        f"The answer to the report's question is {_answer(bend_driven, bend_at_rest)}. With a "
        f"prescribed displacement the bending energies differ by {bend_driven:.1f} % at most: "
        "walls that bend hardly stretch, and bending is linear in both laws. Under a force they "
        f"differ by {_greatest(steady, 'bend_J', 'time_s'):.0f} % for a while, as the softer law "
        f"buckles earlier; at rest the difference is {bend_at_rest:.1f} %.",
    )


def _pair(case):
    return {law: history(varied(case, material={"stretch": law})) for law in LAWS}


def _strain(past):
    return 1e3 * past["time_s"], 100.0 * past["strain"]


def _greatest(pasts, column, x):
    """Greatest difference of a column between the laws, % of its greatest value."""
    one, other = (pasts[law] for law in LAWS)
    gap = np.abs(one[column] - np.interp(one[x], other[x], other[column]))
    return 100.0 * float(gap.max() / one[column].max())


def _at_rest(pasts, column):
    """Difference of a column between the laws at rest under the load, %."""
    one, other = (at(pasts[law], column) for law in LAWS)
    return 100.0 * abs(one / other - 1.0)


def _words(pasts, x):
    strain = "" if x == "strain" else f"strain {_greatest(pasts, 'strain', x):.1f} %, "
    bend, stretch = (_greatest(pasts, name, x) for name in ("bend_J", "stretch_J"))
    return f"{strain}bending {bend:.1f} %, stretching {stretch:.1f} %"


def _answer(driven, at_rest):
    """Whether the laws differ more with a prescribed displacement than at rest under a force."""
    return "no" if driven < max(1.0, at_rest) else "yes"
