"""How much of a lattice is solid: its mass as drawn, and the share of its box that it fills."""

from sweep.config.case import Case
from sweep.config.kinds.sheet import Sheet
from sweep.design.network import mass, relative_density
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.terms import Scene


def drawn_mass(case: Case, scene: Scene | PlateScene) -> float:
    """Mass as drawn, kg."""
    lattice, density = case.lattice, case.material.density
    if isinstance(lattice, Sheet):
        return density * lattice.volume
    return mass(scene.network, lattice.depth, density)


def filled(case: Case, scene: Scene | PlateScene) -> float:
    """Volume as drawn / volume of the outer box."""
    lattice = case.lattice
    if isinstance(lattice, Sheet):
        return lattice.volume / (lattice.width * lattice.height * lattice.depth)
    return relative_density(scene.network, lattice.outer_size)
