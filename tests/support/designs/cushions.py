"""Cases of lattices whose material has a memory."""

from sweep.config.case import Case

BRANCH = {"relaxation_times": (5.0,), "relaxation_shares": (0.6,), "reference_time": 1.0}
SOFT = {"softening_r": 2.0, "softening_m": 2e5}
PLASTIC = {
    "modulus": 2e9,
    "density": 1240.0,
    "poisson": 0.35,
    "yield_stress": 50e6,
    "hardening": 4e7,
}


def cushion(material, lattice=None, contact=None, solver=None, **loading):
    """A crush of a small lattice, to 30 % unless the loading says otherwise."""
    press = {"mode": "displacement", "strain": 0.3} if "mode" not in loading else {}
    return Case.of(
        lattice={"cells_x": 2, "cells_y": 2} | (lattice or {}),
        material=material,
        loading=press | loading,
        contact=contact or {},
        solver={"load_steps": 60} if solver is None else solver,
    )
