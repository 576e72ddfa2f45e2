"""The same grid as our network of walls, of the same rubber."""

from dataclasses import dataclass

import numpy as np

from sweep.config.case import Case
from sweep.scene.beams import plane_factors
from tests.studies.continuum.rubber import Rubber
from tests.support.converged import converged
from tests.support.designs.tables import material_with

MM = 1e-3
MPA = 1e6
STRAINS = np.concatenate([np.arange(-35, 0) / 50.0, [0.01], np.arange(1, 76) / 50.0])  # of curves
STEPS = 300


def material(rubber, plane, bend):
    """The rubber of a plane; sections bend through the law of a bar of it.

    A curve is given in plane stress: the network raises its stresses to plane strain.
    """
    numbers = {"modulus": MPA * rubber.modulus, "poisson": rubber.poisson, "plane": plane}
    plain = material_with(**numbers, density=1190.0, bend="linear")
    if bend == "linear":
        return plain
    stress = MPA * rubber.uniaxial(1.0 + STRAINS) / plane_factors(plain)[1]
    return material_with(
        **numbers,
        density=1190.0,
        name="neo-Hookean",
        bend=bend,
        curve_strain=tuple(STRAINS),
        curve_stress=tuple(stress),
    )


@dataclass(frozen=True)
class Network:
    """A `Grid` as a network of ``pieces`` elements a wall.

    rubber: rubber of the plane. contact, plane, joints, bend: as in the tables of a case.
    """

    grid: object
    rubber: Rubber
    pieces: int = 3
    contact: str = "none"
    plane: str = "stress"
    joints: str = "solid"
    bend: str = "section"

    def case(self, strain, steps):
        """A crush up to a strain."""
        grid = self.grid
        return Case.of(
            lattice=dict(
                cells_x=grid.cells,
                cells_y=grid.cells,
                width=grid.width * MM,
                height=grid.width * MM,
                depth=grid.depth * MM,
                wall_thickness=grid.thickness * MM,
                nodes_per_wall=self.pieces - 1,
                imperfection=grid.bow,
            ),
            material=material(self.rubber, self.plane, self.bend),
            loading=dict(mode="displacement", strain=strain, unload=False, platen="glued"),
            contact=dict(model=self.contact, friction=0.0),
            solver=dict(load_steps=steps, joints=self.joints),
        )

    def crush(self, strain, steps=STEPS):
        """Strain, force in N and energy in mJ of every step."""
        history = converged(self.case(strain, steps)).history
        return history["strain"], history["reaction_top_N"], 1e3 * history["work_in_J"]

    def at(self, strains, steps=STEPS):
        """Force and energy at strains."""
        strain, force, energy = self.crush(float(np.max(strains)), steps)
        return np.interp(strains, strain, force), np.interp(strains, strain, energy)
