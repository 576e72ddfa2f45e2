"""Solid content of a lattice: its mass as drawn, and the share of its box that it fills."""

from sweep.config.case import Case
from sweep.config.kinds.sheet import Surface
from sweep.design.network import mass, relative_density
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.plates.sheet import SheetMesh, solid_of
from sweep.scene.scene import Scene


def drawn_mass(case: Case, scene: Scene | PlateScene) -> float:
    """Mass as drawn, kg."""
    lattice, density = case.lattice, case.material.density
    if isinstance(lattice, Surface):
        assert isinstance(scene.mesh, SheetMesh)
        return density * solid_of(lattice, scene.mesh)
    assert scene.network is not None
    return mass(scene.network, lattice.depth, density)


def filled(case: Case, scene: Scene | PlateScene) -> float:
    """Volume as drawn / volume of the outer box."""
    lattice = case.lattice
    if isinstance(lattice, Surface):
        width, height = lattice.outer_size
        box = width * height * lattice.depth
        return drawn_mass(case, scene) / (case.material.density * box)
    assert scene.network is not None
    return relative_density(scene.network, lattice.outer_size)
