"""Kelvin-Voigt against Rayleigh damping on the same crush."""

from pathlib import Path

import numpy as np
from pandas import DataFrame

from sweep import plots
from sweep.figures.cases import history, ours, varied
from sweep.figures.panels import curves, dress, legend, title
from sweep.params import Case

TIME = 5e-3  # s: beta of the one, relaxation time of the other
SPEEDS = (0.02, 0.05, 0.1, 0.2, 0.5)  # m/s
SHOWN = 0.1
MODELS = {
    "Rayleigh": {"model": "rayleigh", "mass": 0.0, "stiffness": TIME},
    "Kelvin-Voigt": {"model": "kelvin_voigt", "relaxation_time": TIME},
}


def draw(folder: Path) -> tuple[str, ...]:
    """Loop area and rate dependence."""
    pasts = {name: [history(_crush(name, v)) for v in SPEEDS] for name in MODELS}
    figure = plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    shown = SPEEDS.index(SHOWN)
    lines = {name: _loop(runs[shown]) for name, runs in pasts.items()}
    curves(left, lines | {"no damping": _loop(history(_still()))}, "strain, %", "force, N")
    title(left, f"pressed to 40 % and back at {SHOWN:g} m/s")
    legend(left, loc="upper left")
    areas = {name: [_area(past) for past in runs] for name, runs in pasts.items()}
    lost = {name: [_lost(past) for past in runs] for name, runs in pasts.items()}
    curves(right, {n: (SPEEDS, 1e3 * np.array(a)) for n, a in lost.items()}, "", "", marker="o")
    right.axhline(
        1e3 * _area(history(_still())), color=plots.GREY, ls=":", label="loop of no damping"
    )
    right.set(xscale="log", ylim=(0.0, None))
    dress(right, "speed of the platen, m/s", "lost in the material, mJ")
    title(right, "what the material takes in a loop")
    legend(right, loc="upper left")
    plots.save(figure, folder / "damping.png")
    table = "; ".join(
        f"{v:g} m/s: {1e3 * areas['Rayleigh'][i]:.0f} and {1e3 * areas['Kelvin-Voigt'][i]:.0f} mJ, "
        f"of which the material takes {1e3 * lost['Rayleigh'][i]:.1f} and "
        f"{1e3 * lost['Kelvin-Voigt'][i]:.1f} mJ"
        for i, v in enumerate(SPEEDS)
    )
    slopes = [np.log(a[1] / a[0]) / np.log(SPEEDS[1] / SPEEDS[0]) for a in lost.values()]
    return (
        "The report damps by Rayleigh and names Kelvin-Voigt as future work.",
        f"Area of the loop for Rayleigh and Kelvin-Voigt with the same time, {1e3 * TIME:g} ms: "
        f"{table}. Without damping and at no speed the loop has "
        f"{1e3 * _area(history(_still())):.1f} mJ. From {SPEEDS[0]:g} to {SPEEDS[1]:g} m/s the loss "
        f"grows with the power {slopes[0]:.2f} (Rayleigh) and {slopes[1]:.2f} (Kelvin-Voigt) of the "
        "speed.",
        "Both lose in proportion to the rate of strain, so nearly nothing at test speeds of 100 "
        "mm/min, where printed TPU loses a quarter and more. They differ by the stiffness that "
        "they damp: Rayleigh takes the tangent one of the step's start, which grows with contact "
        "and tension and resists turning, Kelvin-Voigt that of the straight wall.",
    )


def _still() -> Case:
    loading = {"mode": "displacement", "strain": 0.4, "platen": "glued"}
    return varied(ours(), loading=loading, contact={"friction": 0.0})


def _crush(model: str, speed: float) -> Case:
    loading = {"mode": "displacement", "strain": 0.4, "platen": "glued", "speed": speed}
    return varied(ours(), loading=loading, damping=MODELS[model], contact={"friction": 0.0},
                  solver={"load_steps": 400})  # fmt: skip


def _loop(past: DataFrame) -> tuple[DataFrame, DataFrame]:
    return 100.0 * past["strain"], past["reaction_top_N"]


def _area(past: DataFrame) -> float:
    """Work that the platen does not get back, J."""
    return float(past["work_in_J"].iloc[-1])


def _lost(past: DataFrame) -> float:
    return float(past["dissipated_material_J"].iloc[-1])
