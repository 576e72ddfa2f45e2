"""The same grid as our network of walls: with joints that are points, or elastic blocks.

Blocks are numbers of hinges alone. A wall of n elements keeps the flexibilities f_e at its two ends
and f_i inside; they sum to its length L' in even bending, L (1 - spared t / L), and their squares
about its middle to q L^3 / 12 in bending by shear, q = (4 l^3 + b l^2 + c l + d) / 4 l^3 at
l = L / 2 t (see `joint`). Point joints are q = 1 and nothing spared.
"""

from dataclasses import dataclass, replace
from unittest.mock import patch

import numpy as np

from sweep.params import Case, Contact, Lattice, Loading, Material, Solver
from sweep.scene import build_scene
from sweep.simulate import simulate

MM = 1e-3


@dataclass(frozen=True)
class Block:
    """Coefficients of `joint.coefficients`."""

    square: float
    linear: float
    constant: float
    spared: float

    def flexibility(self, slenderness, pieces):
        """f_e and f_i over L / Y I of walls of t / L = ``slenderness``."""
        arm = 0.5 / slenderness
        sheared = 1.0 + (self.square * arm**2 + self.linear * arm + self.constant) / (4 * arm**3)
        even = 1.0 - self.spared * slenderness
        at_end = (pieces * sheared - (pieces - 2) * even) / (4 * pieces + 4)
        if at_end <= 0.0:
            raise ValueError(f"{pieces} elements are too many for joints as wide as {slenderness}")
        return at_end, (even - 2.0 * at_end) / (pieces - 1)


POINTS = Block(0.0, 0.0, 0.0, 0.0)


def built(case, block):
    """The scene of a case of equal walls with such joints."""
    scene, pieces = build_scene(case), case.lattice.nodes_per_wall + 1
    slenderness = case.lattice.wall_thickness * case.lattice.cells_x / case.lattice.width
    of_points = np.array(POINTS.flexibility(slenderness, pieces))
    arm, hinge = of_points / block.flexibility(slenderness, pieces)
    bending = scene.terms.bend
    stiffened = bending._replace(
        arm_stiffness=arm * bending.arm_stiffness, hinge_stiffness=hinge * bending.hinge_stiffness
    )
    return replace(scene, terms=scene.terms._replace(bend=stiffened))


@dataclass(frozen=True)
class Network:
    """A `Grid` of linear rubber in plane stress as a network of ``pieces`` elements a wall."""

    grid: object
    rubber: object
    pieces: int = 6
    block: Block = POINTS
    contact: str = "none"

    def crush(self, strain, steps):
        """Strain, force in N and energy in mJ of every step."""
        grid, rubber = self.grid, self.rubber
        case = Case(
            lattice=Lattice(
                cells_x=grid.cells,
                cells_y=grid.cells,
                width=grid.width * MM,
                height=grid.width * MM,
                depth=grid.depth * MM,
                wall_thickness=grid.thickness * MM,
                nodes_per_wall=self.pieces - 1,
                imperfection=grid.bow,
            ),
            material=Material(
                modulus=1e6 * rubber.modulus, density=1190.0, poisson=rubber.poisson, plane="stress"
            ),
            loading=Loading(mode="displacement", strain=strain, unload=False),
            contact=Contact(model=self.contact, friction=0.0),
            solver=Solver(load_steps=steps),
        )
        with patch("sweep.simulate.build_scene", lambda case: built(case, self.block)):
            result = simulate(case)
        if result.status != "converged":
            raise RuntimeError(result.message)
        history = result.history
        return history["strain"], history["reaction_top_N"], 1e3 * history["work_in_J"]

    def at(self, strains, steps=600):
        """Force and energy at strains."""
        strain, force, energy = self.crush(float(np.max(strains)), steps)
        return np.interp(strains, strain, force), np.interp(strains, strain, energy)

    def stiffness(self):
        """Force at rest over the strain, N."""
        strain, force, _ = self.crush(SMALL, 1)
        return float(force[-1] / strain[-1])


SMALL = 1e-5  # strain, far from buckling
