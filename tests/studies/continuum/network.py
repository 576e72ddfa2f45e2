"""The same grid as our network of walls: as it is, or with what a solid does beyond beams.

Blocks: walls are stiffer in bending by 1 / (1 - spared t / L), see `joint`. Thick sections: the
moment is Y I kappa / (1 + softening (kappa t)^2), see `strip`.
"""

from dataclasses import dataclass, replace
from unittest.mock import patch

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from kernels.terms.elastic import MomentCurve
from sweep.config.case import Case, Contact, Lattice, Loading, Material, Solver
from sweep.scene.lattice import build_scene
from sweep.scene.material import StressLaw, as_law
from sweep.simulation.simulate import simulate

MM = 1e-3
SMALL = 1e-5  # strain, far from buckling
SURFACE = np.linspace(0.0, 1.0, 301)  # strain of the surface, kappa t / 2


def thick_law(softening):
    """Moment of a thick section over Y I 2 / t, over the strain of its surface."""
    below = 1.0 + 4.0 * softening * SURFACE**2
    slope = (2.0 - below) / below**2
    spline = CubicHermiteSpline(SURFACE, SURFACE / below, slope)
    return MomentCurve(
        *as_law(StressLaw(spline.x, np.ascontiguousarray(spline.c[::-1].T)), 1.0, 1.0)
    )


def built(case, spared, softening):
    """The scene of a case of equal walls, its bending changed."""
    scene, lattice = build_scene(case), case.lattice
    bending, pitch = scene.terms.bend, lattice.width / lattice.cells_x
    stiffer = 1.0 / (1.0 - spared * lattice.wall_thickness / pitch)
    bending = bending._replace(stiffness=stiffer * bending.stiffness)
    if softening > 0.0:
        surface, per_length = (
            0.5 * scene.mesh.thickness / scene.mesh.rest_length,
            bending.stiffness[1],
        )
        weight = 0.25 * per_length / surface**2  # half of Y I / h at each of two points
        bending = bending._replace(
            section=thick_law(softening), surface=surface, weight=np.tile(weight, (2, 1))
        )
    return replace(scene, terms=scene.terms._replace(bend=bending))


@dataclass(frozen=True)
class Network:
    """A `Grid` in plane stress as a network of ``pieces`` elements a wall, two or more.

    spared, softening: of blocks and of thick sections.
    """

    grid: object
    rubber: object
    pieces: int = 6
    contact: str = "none"
    spared: float = 0.0
    softening: float = 0.0

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
        made = built(case, self.spared, self.softening)
        with patch("sweep.simulation.simulate.build_scene", lambda case: made):
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
