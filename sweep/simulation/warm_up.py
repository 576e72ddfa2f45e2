"""Small cases of each kind of kernels, which load or compile these before a case needs them."""

from collections.abc import Iterable, Mapping, Sequence

from sweep.config.case import Case, complete
from sweep.config.kinds.solver import Arcs
from sweep.config.kinds.table import Inputs
from sweep.config.structures.structure import Load, Structure, Support
from sweep.simulation.simulate import simulate

CELL = {"cells_x": 1, "cells_y": 1}
WALL = Structure(
    nodes_mm=((0, 0), (10, 0)),
    walls=((0, 1),),
    supports=(Support(node=0, fix=("x", "y", "rotation")),),
    loads=(Load(node=1, force_N=(0.0, -1e-3)),),
)
PRESSED: Inputs = {
    "loading": {"direction": "out_of_plane", "strain": 1e-3, "unload": False},
    "solver": {"load_steps": 1},
}
SMALLEST: Mapping[str, Sequence[Inputs]] = {
    "marches": [
        {
            "lattice": CELL,
            "loading": {"release_time": 1e-4, "duration": 2e-4},
            "solver": {"time_step": 1e-4},
        }
    ],
    "arcs": [
        {
            "lattice": {"kind": "custom", "structure": WALL},
            "solver": {"integrator": "arc_length", "load_steps": 1},
        }
    ],
    "plates": [
        {**PRESSED, "lattice": CELL | {"nodes_per_wall": 1, "layers": 2}},
        {**PRESSED, "lattice": {"kind": "gyroid", "nodes_per_wall": 1}},
    ],
}
"""Cases of each kind of kernels: motion and crushes in the plane, arc lengths, shells that are flat
at rest and others.
"""


def kernels_of(case: Case) -> str:
    """Which kernels a case runs on, a key of `SMALLEST`."""
    if case.shells:
        return "plates"
    return "arcs" if isinstance(case.solver, Arcs) else "marches"


def warm_up(kernels: Iterable[str] = ("marches",)) -> None:
    """Load or compile kernels, by their keys in `SMALLEST`, so that no case spends time on it."""
    for name in kernels:
        for tables in SMALLEST[name]:
            simulate(complete(tables).sound())
