"""Problems that compare elements: a structure, a measured number, and its truth.

The truth comes from exact rods (`exact`), for cantilevers from the elastica in elliptic integrals,
and where walls touch from a mesh of `FINEST` elements.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from sweep.result import Result
from tests.studies.validation import frames, pressed
from tests.studies.validation.elastica import cantilever
from tests.studies.validation.exact import WAYS, Frame
from tests.studies.validation.problem import bending
from tests.support.designs.structures import APART, BEAM, LENGTH, MM, probe, pushed

NEAR = 12  # elements a wall of the shape at which the search for exact rods begins
FINEST = 48
STIFF = (12.0 / 1e5) ** 0.5  # thickness / length of arms with Y A = 1e5 Y I / L^2
TOLERANCE = 1e-9
REACTIONS = ("reaction_x_N", "reaction_y_N", "reaction_moment_Nm")


@dataclass(frozen=True, eq=False)
class Scene:
    """parts: of the structure, without its mesh. measure: a number of a result. truth: how to find
    it elsewhere. steps: of the load. options: of the solver, for this scene alone.
    """

    name: str
    parts: Mapping
    measure: Callable[[Result], float]
    truth: Callable[["Scene"], float]
    steps: int = 20
    contact: Mapping = field(default_factory=lambda: APART)
    options: Mapping = field(default_factory=lambda: MappingProxyType({}))

    def solve(self, pieces, element="cubic"):
        """Result with so many elements in every wall: the options of all scenes are here."""
        parts = {**self.parts, "subdivide": pieces}
        options = {"element": element, "tolerance": TOLERANCE, **self.options}
        return pushed(parts, self.steps, self.contact, **options)

    def value(self, pieces, element="cubic"):
        """The measured number with this many elements in every wall."""
        return self.measure(self.solve(pieces, element))


def driven(name, parts, steps):
    """A scene of prescribed moves: the force or moment that holds them, against exact rods."""
    led = [(part["node"], part["direction"]) for part in parts["prescribed"]]
    columns = [(node, REACTIONS[WAYS.index(way)]) for node, way in led]

    def measure(result):
        return sum(probe(result, *column)[-1] for column in columns)

    def exactly(scene):
        frame = Frame(parts).near(scene.solve(NEAR).frames["position_m"][-1]).solve(1.0)
        return sum(frame.reaction(*held) for held in led)

    return Scene(name, parts, measure, exactly, steps=steps)


def columns():
    """Clamped and hinged columns, shortened by up to 40 %."""
    for clamped, slenderness, shares in (
        (True, 0.064, (5, 20, 40)),
        (False, 0.064, (40,)),
        (True, 0.01, (40,)),
        (False, 0.01, (40,)),
    ):
        kind = "clamped" if clamped else "hinged"
        for share in shares:
            name = f"{kind} column, t/L {slenderness}, {share} %"
            yield driven(name, pressed.column(clamped, slenderness, share / 100), share)


def crosses():
    """Crosses of stout arms and of arms that hardly stretch, with the joint turned."""
    for slenderness, angles in ((0.05, (0.5,)), (STIFF, (0.1, 0.3, 0.5))):
        for angle in angles:
            name = f"clamped cross, t/L {slenderness:.2g}, {angle} rad"
            yield driven(name, pressed.cross(slenderness, angle), 10)


def lattices():
    """A cell, the grid of 3 x 3 and a patch of hexagons."""
    yield driven("cell between hinges, t/L 0.01, 40 %", pressed.cell(0.01, 0.4), 40)
    yield driven("cell on its corner, t/L 0.01, 40 %", pressed.on_corner(0.01, 0.4), 40)
    for thickness, slenderness, shares in ((0.8, 0.19, (5, 10, 30)), (0.2, 0.05, (30,))):
        for share in shares:
            name = f"3 x 3 grid, t/L {slenderness}, {share} %"
            yield driven(name, pressed.grid(thickness, share / 100), 2 * share)
    yield driven("hexagons, t/L 0.05, 30 %", pressed.hexagons(0.05, 0.3), 60)
    yield Scene(
        "3 x 3 grid with contact, 60 %: work",
        pressed.grid(0.8, 0.6),
        lambda result: result.history["work_in_J"][-1],
        lambda scene: scene.value(FINEST),
        steps=120,
        contact=dict(friction=0.0),
    )


def limit(column):
    """The first greatest value along a path; NaN where it never falls."""
    return frames.first_peak(column) if (np.diff(column) < 0.0).any() else np.nan


def snapped(result):
    """Load factor at the first limit point."""
    return limit(result.history["load_factor"])


def sunk(result):
    """How far the loaded point of Lee's frame sinks before it rises again, over L."""
    return limit(0.12 - probe(result, 2, "y_m")) / 0.12


def frame_scenes():
    """The portal, Lee's frame and Williams' toggle."""
    yield Scene(
        "portal under 8 Y I / L^2: sway",
        frames.PORTAL,
        lambda result: probe(result, 1, "x_m")[-1] / 0.1,
        lambda _: frames.sway_exactly(),
    )
    arcs = {"integrator": "arc_length"}
    for name, measure, truth in (
        ("Lee's frame: first limit load", snapped, lambda _: frames.lee_limit_exactly() / 20.0),
        ("Lee's frame: turning point", sunk, lambda _: frames.lee_return_exactly()),
    ):
        yield Scene(name, frames.LEE, measure, truth, steps=800, options=arcs)
    yield Scene(
        "Williams' toggle: first limit load",
        frames.WILLIAMS,
        snapped,
        lambda _: frames.williams_exactly(),
        steps=1200,
        options=arcs | {"arc_length": 6e-6},
    )


def cantilevers():
    """The elastica under a force, and bent to half a circle by a moment."""
    thin = 0.01  # mm: these forces hardly stretch it
    force = bending(thin) / (LENGTH * MM) ** 2
    for size in (1.0, 10.0):
        yield Scene(
            f"cantilever, P L^2 = {size:g} Y I: drop".replace(" 1 ", " "),
            BEAM | {"wall_thickness_mm": thin}
            | {"loads": [{"node": 1, "force_N": [0.0, -size * force]}]},
            lambda result: -probe(result, 1, "y_m")[-1] / (LENGTH * MM),
            lambda _, size=size: cantilever(size)[0],
        )  # fmt: skip
    yield Scene(
        "cantilever, M L = pi Y I: height",
        BEAM | {"wall_thickness_mm": thin}
        | {"loads": [{"node": 1, "moment_Nmm": np.pi * force * LENGTH}]},
        lambda result: probe(result, 1, "y_m")[-1] / (LENGTH * MM),
        lambda _: 2.0 / np.pi,
    )  # fmt: skip


SCENES = (*columns(), *crosses(), *cantilevers(), *frame_scenes(), *lattices())
