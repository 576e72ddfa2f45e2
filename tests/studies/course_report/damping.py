"""Kelvin-Voigt against Rayleigh damping on the same crush."""

import numpy as np

from sweep.report.figures import case_plots
from sweep.scene.material import stress_law
from tests.studies.course_report.cases import history, ours, varied
from tests.studies.panels import curves, dress, legend, ticks, title

TIME = 5e-3  # s: beta of Rayleigh, and relaxation time of Kelvin-Voigt
SPEEDS = (0.02, 0.05, 0.1, 0.2, 0.5)  # m/s
SHOWN = 0.1
MODELS = {
    "Rayleigh": {"model": "rayleigh", "mass": 0.0, "stiffness": TIME},
    "Kelvin-Voigt": {"model": "kelvin_voigt", "relaxation_time": TIME},
}


def draw(folder):
    """Loop area and rate dependence."""
    pasts = {name: [history(_crush(name, v)) for v in SPEEDS] for name in MODELS}
    figure = case_plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    shown = SPEEDS.index(SHOWN)
    lines = {name: _loop(runs[shown]) for name, runs in pasts.items()}
    curves(left, lines | {"no damping": _loop(history(_undamped()))}, "strain, %", "force, N")
    title(left, f"pressed to 40 % and back at {SHOWN:g} m/s")
    legend(left, loc="upper right")
    areas = {name: [_area(past) for past in runs] for name, runs in pasts.items()}
    in_material = "dissipated_material_J"
    lost = {name: [past[in_material].iloc[-1] for past in runs] for name, runs in pasts.items()}
    curves(right, {n: (SPEEDS, 1e3 * np.array(a)) for n, a in lost.items()}, "", "", marker="o")
    right.set(xscale="log", yscale="log")
    ticks(right.xaxis, SPEEDS)
    ticks(right.yaxis, (20, 50, 100, 200, 400))
    dress(right, "speed of the platen, m/s", "lost in the material, mJ")
    title(right, "dissipated by the material in a loop")
    legend(right, loc="upper left")
    case_plots.save(figure, folder / "damping.png")
    table = "; ".join(
        f"{v:g} m/s: {_both(areas, i)}, of which {_both(lost, i)} in the material"
        for i, v in enumerate(SPEEDS)
    )
    powers = [np.log(a[-1] / a[0]) / np.log(SPEEDS[-1] / SPEEDS[0]) for a in lost.values()]
    material = ours().material
    return (
        "The report uses Rayleigh damping and names Kelvin-Voigt as future work.",
        f"Area of the loop for Rayleigh and Kelvin-Voigt with the same time, {1e3 * TIME:g} ms: "
        f"{table}. Without damping, quasi-static, the loop has "
        f"{1e3 * _area(history(_undamped())):.2f} mJ. The loss grows with the power "
        f"{powers[0]:.2f} (Rayleigh) and {powers[1]:.2f} (Kelvin-Voigt) of the speed.",
        "Both losses are proportional to the strain rate: almost zero at the 100 mm/min of a test, "
        "where printed TPU loses a quarter and more. The models differ in the stiffness that they "
        f"damp. Rayleigh uses the tangent at the start of a step, {1e-6 * _slope(material):.1f} "
        f"MPa at rest, Kelvin-Voigt the modulus, {1e-6 * material.modulus:.1f} MPa: their ratio is "
        f"{_slope(material) / material.modulus:.2f}, and that of the forces at the first touch is "
        f"{_first(pasts['Rayleigh'][shown]) / _first(pasts['Kelvin-Voigt'][shown]):.2f}. "
        "Kelvin-Voigt dissipates nothing in a rigid rotation of a wall.",
    )


def _both(values, i):
    return " and ".join(f"{1e3 * v[i]:.1f}" for v in values.values()) + " mJ"


def _first(past):
    """Force on the platen in the first step, N."""
    return float(past["reaction_top_N"].iloc[1])


def _slope(material):
    """Slope of the curve at rest, Pa."""
    law = stress_law(material)
    return float(law.coefficients[np.searchsorted(law.knots, 0.0, "right") - 1, 1])


def _undamped():
    loading = {"mode": "displacement", "strain": 0.4, "platen": "glued"}
    return varied(ours(), loading=loading, contact={"friction": 0.0})


def _crush(model, speed):
    loading = {"mode": "displacement", "strain": 0.4, "platen": "glued", "speed": speed}
    return varied(ours(), loading=loading, damping=MODELS[model], contact={"friction": 0.0},
                  solver={"load_steps": 400, "integrator": "backward_euler"})  # fmt: skip


def _loop(past):
    return 100.0 * past["strain"], past["reaction_top_N"]


def _area(past):
    """Work that the platen does not get back, J."""
    return float(past["work_in_J"].iloc[-1])
