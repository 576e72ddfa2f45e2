"""Endless lattices of slender walls, 1 cm long, whose joints are points."""

from sweep.config.case import Case

LENGTH, DEPTH, MODULUS = 1e-2, 1e-2, 1e6  # m, m, Pa
PERIODS = {
    "square": (1.0, 1.0),
    "hex": (3**0.5, 1.5),
    "triangle": (1.0, 0.75**0.5),
    "kagome": (2.0, 3**0.5),
}
"""Width and height of a cell over the length of a wall."""


def slender(kind, ratio=0.01, cells=(2, 2), way="pointy", **material):
    """A case of regular cells of walls of a thickness / length; ``way``: orientation."""
    period = PERIODS[kind][::-1] if way == "flat" else PERIODS[kind]
    lattice = {
        "kind": kind,
        "boundary": "periodic",
        "cells_x": cells[0],
        "cells_y": cells[1],
        "width": cells[0] * period[0] * LENGTH,
        "height": cells[1] * period[1] * LENGTH,
        "depth": DEPTH,
        "wall_thickness": ratio * LENGTH,
    }
    lattice |= {"orientation": way} if kind == "hex" else {}
    given = {"modulus": MODULUS, "density": 1200.0, "poisson": 0.3, "plane": "stress"} | material
    loading = {"mode": "displacement", "strain": 1e-5, "unload": False}
    return Case.of(
        lattice=lattice,
        material=given,
        loading=loading,
        contact={"model": "none"},
        solver={"joints": "points"},
    )
