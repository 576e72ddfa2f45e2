"""Frames under large forces, and structures that snap: limit points along arcs."""

import numpy as np

from tests.studies.validation.exact import Frame
from tests.studies.validation.problem import RODS, Problem, bending
from tests.support.designs.structures import AXIAL, CLAMPED, MM, probe, pushed

HINGED = ["x", "y"]

PORTAL = {
    "nodes_mm": [[0, 0], [0, 100], [100, 100], [100, 0]],
    "walls": [[0, 1], [1, 2], [2, 3]],
    "supports": [{"node": node, "fix": CLAMPED} for node in (0, 3)],
    "loads": [{"node": 1, "force_N": [8.0 * bending(1.0) / 0.1**2, 0.0]}],
    "wall_thickness_mm": 1.0,
    "probes": [1],
}


def sway(pieces):
    """Sway over its height of a clamped portal under a side force of 8 Y I / L^2."""
    return probe(pushed(PORTAL | {"subdivide": pieces}), 1, "x_m")[-1] / 0.1


# Lee, Manuel & Rossow 1968: 18.552 Y I / L^2 for walls that do not stretch; ours have t = L / 120.
LEE = {
    "nodes_mm": [[0, 0], [0, 120], [24, 120], [120, 120]],
    "walls": [[0, 1], [1, 2], [2, 3]],
    "supports": [{"node": node, "fix": HINGED} for node in (0, 3)],
    "loads": [{"node": 2, "force_N": [0.0, -20.0 * bending(1.0) / 0.12**2]}],
    "wall_thickness_mm": 1.0,
    "probes": [2],
}
# Williams 1964: half span 12.943 in, rise 0.386 in, walls 0.753 x 0.243 in; here ten mm an inch.
HALF, RISE, WALL = 129.43, 3.86, 2.43
WILLIAMS = {
    "nodes_mm": [[-HALF, 0], [0, RISE], [HALF, 0]],
    "walls": [[0, 1], [1, 2]],
    "supports": [{"node": node, "fix": CLAMPED} for node in (0, 2)],
    "wall_thickness_mm": WALL,
    "loads": [{"node": 1, "force_N": [0.0, -bending(WALL) / (MM * HALF) ** 2]}],
    "probes": [1],
}


def lee(pieces):
    """Lee's frame of three walls, with as many elements in each of its two legs."""
    return LEE | {"subdivide": [pieces, pieces // 4, pieces - pieces // 4]}


def followed(parts, arcs=200, arc_length=None):
    """Load factor and the probe's places x and y in m (rows,) along the path of a structure."""
    result = pushed(parts, arcs, integrator="arc_length", arc_length=arc_length)
    node = parts["probes"][0]
    return result.history["load_factor"], probe(result, node, "x_m"), probe(result, node, "y_m")


def peak(column, k):
    """Extremum of the parabola through the rows about ``k``."""
    a, b, c = column[k - 1 : k + 2]
    return b - 0.125 * (c - a) ** 2 / (a - 2.0 * b + c)


def first_peak(column):
    """The first greatest value along a path."""
    return peak(column, np.flatnonzero(np.diff(column) < 0.0)[0])


def lee_limit(pieces):
    """First limit load of Lee's frame, P L^2 / Y I."""
    return 20.0 * first_peak(followed(lee(pieces))[0])


def lee_return(pieces):
    """How far its loaded point sinks before it rises again while the load falls, over L."""
    _, _, y = followed(lee(pieces))
    return first_peak(0.12 - y) / 0.12


def lee_exactly():
    """Lee's frame of exact rods close below its first limit load."""
    return Frame(LEE).solve(0.9, 4)


def load(frame):
    """The load that is on."""
    return frame.factor


def lee_limit_exactly():
    """First limit load of exact rods."""
    return 20.0 * lee_exactly().greatest(2, "y", -0.01, load)


def lee_return_exactly():
    """How far their loaded point sinks, over L."""
    return 1.0 + lee_exactly().greatest(2, "x", 0.02, lambda frame: -frame.place(2, "y"))


def williams_limit(pieces):
    """First limit load of Williams' toggle, P l^2 / Y I of half its span."""
    factor, _, _ = followed(WILLIAMS | {"subdivide": pieces}, 150, 5e-5)
    return first_peak(factor)


def williams_exactly():
    """The same for exact rods."""
    return Frame(WILLIAMS).greatest(1, "y", -0.0015, load)


TRUSS = {
    "nodes_mm": [[-100, 0], [0, 20], [100, 0]],
    "walls": [[0, 1], [1, 2]],
    "pins": [0, 1, 2],
    "supports": [{"node": node, "fix": HINGED} for node in (0, 2)],
    "loads": [{"node": 1, "force_N": [0.0, -4e-3 * AXIAL]}],
    "probes": [1],
}


def truss_force(height):
    """Force (N) down on the apex of von Mises' truss that holds it at a ``height`` (m)."""
    rest, length = np.hypot(0.1, 0.02), np.hypot(0.1, height)
    return 2.0 * AXIAL * (1.0 - length / rest) * height / length


def truss_limit(_):
    """Limit load of von Mises' truss over Y A."""
    return 4e-3 * first_peak(followed(TRUSS | {"subdivide": 1}, 1000)[0])


def truss_exactly():
    """The same in closed form: the bars' length is a mean, l^3 = l0 d^2 of half the span d."""
    length = np.cbrt(np.hypot(0.1, 0.02) * 0.1**2)
    return truss_force(np.sqrt(length**2 - 0.1**2)) / AXIAL


def sway_exactly():
    """The same for exact rods."""
    return Frame(PORTAL).solve(1.0, 4).place(1, "x")


PROBLEMS = (
    Problem("portal under 8 Y I / L^2: sway", sway, sway_exactly, RODS),
    Problem("von Mises truss: limit load", truss_limit, truss_exactly, "closed form", order=0),
    Problem("Lee's frame: first limit load", lee_limit, lee_limit_exactly, RODS),
    Problem("Lee's frame: where it turns back", lee_return, lee_return_exactly, RODS),
    Problem("Williams' toggle: first limit load", williams_limit, williams_exactly, RODS),
)
