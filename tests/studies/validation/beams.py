"""Cantilevers and columns: the elastica."""

import numpy as np

from tests.studies.validation.elastica import cantilever, deflection
from tests.studies.validation.exact import Frame
from tests.studies.validation.problem import ELASTICA, EULER, RODS, Problem, axial, bending
from tests.support.designs.structures import BEAM, CLAMPED, LENGTH, MM, THICKNESS, probe, pushed

THIN = 0.5  # mm, so that stretching hardly matters
L = LENGTH * MM
BEYOND = 1.5  # times the Euler load
FORCE = bending(THIN) / L**2
THINNED = {"wall_thickness_mm": THIN}
SIDEWAYS = 1e-4  # of the Euler load


def drop(size):
    """Drop of the end over L as a function of the mesh, under P L^2 / Y I."""

    def value(pieces):
        load = {"loads": [{"node": 1, "force_N": [0.0, -size * FORCE]}]}
        return -probe(pushed(BEAM | THINNED | load | {"subdivide": pieces}), 1, "y_m")[-1] / L

    return value


TWO = {"nodes_mm": [[0, 0], [LENGTH / 2, 0], [LENGTH, 0]], "walls": [[0, 1], [1, 2]]}


def rolled(pieces):
    """Width over L of the circle into which an end moment rolls a beam."""
    moment = {"loads": [{"node": 2, "moment_Nmm": 2.0 * np.pi * FORCE * L / MM}]}
    held = {"supports": [{"node": 0, "fix": CLAMPED}], "probes": [1]}
    result = pushed(TWO | THINNED | held | moment | {"subdivide": pieces // 2}, steps=20)
    return np.hypot(probe(result, 1, "x_m")[-1], probe(result, 1, "y_m")[-1]) / L


def euler_load(clamped, thickness):
    """N."""
    return (4.0 if clamped else 1.0) * np.pi**2 * bending(thickness) / L**2


def shortened(clamped):
    """Buckling load over Euler's of a column that shortens: P (1 - P / Y A) is the Euler load."""
    share = euler_load(clamped, THICKNESS) / axial(THICKNESS)
    return (1.0 - np.sqrt(1.0 - 4.0 * share)) / (2.0 * share)


def column(load, sideways, clamped):
    """A column under a multiple of its Euler load, with a push to the side at its middle."""
    euler = euler_load(clamped, THICKNESS)
    ends = [["x", "y"], ["y"]]
    return TWO | {
        "supports": [
            {"node": node, "fix": fix + ["rotation"] * clamped}
            for node, fix in zip((0, 2), ends, strict=True)
        ],
        "loads": [
            {"node": 2, "force_N": [-load * euler, 0.0]},
            {"node": 1, "force_N": [0.0, sideways * euler]},
        ],
        "probes": [1],
    }


def critical(clamped):
    """Load over Euler's at which a column has no stiffness sideways, as a function of the mesh.

    Extrapolated from stiffnesses below it by a polynomial.
    """

    def value(pieces):
        parts = column(0.95, SIDEWAYS, clamped) | {"subdivide": pieces // 2}
        result = pushed(parts, steps=20, tolerance=1e-10)
        factor = result.history["load_factor"][8:]
        stiffness = SIDEWAYS * factor * L / probe(result, 1, "y_m")[8:]
        through = np.polynomial.Polynomial.fit(factor, stiffness, 6)
        roots = through.roots()
        return 0.95 * roots[np.argmin(abs(roots - 1.0))].real

    return value


def bent(clamped):
    """Deflection over L of a column under a load beyond Euler's, as a function of the mesh."""

    def value(pieces):
        result = pushed(column(BEYOND, 0.0, clamped) | {"subdivide": pieces // 2}, steps=20)
        return abs(probe(result, 1, "y_m")[-1]) / L

    return value


def bent_exactly(clamped):
    """The same for exact rods, sought near a sine or a cosine of the inextensible deflection."""

    def truth():
        frame = Frame(column(BEYOND, 0.0, clamped))
        x, height = 0.5 * frame.y[:, 0], 2.0 * deflection(BEYOND)
        wave = (2.0 if clamped else 1.0) * np.pi
        frame.y[:, 1] = height * (0.5 - 0.5 * np.cos(wave * x) if clamped else np.sin(wave * x))
        frame.y[:, 2] = np.gradient(frame.y[:, 1], axis=1) / np.gradient(frame.y[:, 0], axis=1)
        return abs(frame.solve(1.0).place(1, "y")) / 2.0

    return truth


PROBLEMS = (
    Problem("cantilever, P L^2 = Y I: drop", drop(1.0), cantilever(1.0)[0], ELASTICA),
    Problem("cantilever, P L^2 = 10 Y I: drop", drop(10.0), cantilever(10.0)[0], ELASTICA),
    Problem("beam rolled up by a moment: width", rolled, 1.0 / np.pi, "circle"),
    Problem("hinged column: buckling load", critical(False), shortened(False), EULER),
    Problem("clamped column: buckling load", critical(True), shortened(True), EULER),
    Problem("hinged column at 1.5 of that: bow", bent(False), bent_exactly(False), RODS, (2, 4, 8)),
    Problem("clamped column at 1.5 of that: bow", bent(True), bent_exactly(True), RODS),
)
