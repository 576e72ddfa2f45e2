"""The comparison itself: a crush with contact, and grids of slender to stout walls without."""

from dataclasses import dataclass, replace

import numpy as np

from tests.studies.continuum import joint, strip
from tests.studies.continuum.grid import Grid
from tests.studies.continuum.network import Network
from tests.studies.continuum.press import Press
from tests.studies.continuum.rubber import Rubber
from tests.studies.continuum.solid import Solid
from tests.studies.continuum.touch import Touch

RUBBER = Rubber(12.0, 0.48)
MESHES = (2, 4)  # elements through a wall
FINE = 16  # through a wall of a joint by itself
PIECES = 6  # elements of a wall of the network
REACH = 0.006  # of the thickness: gap of surfaces that touch
STEP = 0.01  # of the strain
WATCHED = (0.1, 0.3, 0.4, 0.5, 0.6)
SLENDER = (0.05, 0.1, 0.15, 0.2, 0.3)  # t / L
COARSER, POINTS, BLOCKS = "coarser solid", "network", "network, elastic blocks"
THICK = "network, elastic blocks, thick sections"
APART = (0.1, 0.2)  # strains before walls touch


def solid(grid, contact):
    """The grid as a body between platens."""
    body = Solid(grid.mesh(), RUBBER, grid.depth)
    if not contact:
        return Press(body, grid.width)
    stiffness = RUBBER.modulus * grid.depth
    return Press(body, grid.width, Touch(body, REACH * grid.thickness, stiffness))


def pressed(press, strain):
    """Curve of a body up to a strain."""
    return press.crush(STEP * np.arange(1, round(strain / STEP) + 1))


def beyond_beams():
    """What joints spare and by how much thick sections soften, as elasticity has it."""
    return {"spared": joint.spared(FINE, RUBBER.poisson), "softening": strip.softening(RUBBER)}


@dataclass(frozen=True)
class Side:
    """A name, and (strain, force in N, energy in mJ) of a crush; the body at its end, if one."""

    name: str
    rows: np.ndarray
    body: object = None
    shape: object = None

    def at(self, strains):
        """Force and energy."""
        strain, force, energy = self.rows
        return np.interp(strains, strain, force), np.interp(strains, strain, energy)


def crushed(beyond):
    """All sides of the crush to the last strain watched; the finest body comes last."""
    for pieces, changed, name in (
        (3, {}, "network, 3 elements a wall (default)"),
        (6, {}, "network, 6"),
        (12, {}, "network, 12"),
        (6, beyond, "network, 6, elastic blocks, thick sections"),
    ):
        network = Network(Grid(), RUBBER, pieces, "barrier", **changed)
        yield Side(name, np.array(network.crush(WATCHED[-1], 300)))
    for across in MESHES:
        press = solid(Grid(across=across), True)
        curve = pressed(press, WATCHED[-1])
        name = f"solid, {across} elements through a wall"
        yield Side(name, np.array(curve.rows).T, press.body, curve.shape)


@dataclass(frozen=True)
class Compared:
    """A slenderness: stiffness, forces, energies of the fine solid, and errors in % of others."""

    slenderness: float
    truth: np.ndarray
    errors: dict


def measured(side):
    """Stiffness (N), forces (N) and energies (mJ) at the strains before contact."""
    return np.concatenate([[side.stiffness()], *side.at(APART)])


class Body:
    """A solid without contact, asked like a network."""

    def __init__(self, grid):
        self.press = solid(grid, False)
        self.stiffness, self.at = self.press.stiffness, pressed(self.press, APART[-1]).at


def compared(slenderness, beyond):
    """The network, as it is and changed, beside solids, at a thickness over pitch."""
    coarse, fine = (Grid(thickness=slenderness * Grid().pitch, across=across) for across in MESHES)
    truth = measured(Body(fine))
    network, blocks = Network(fine, RUBBER, PIECES), {"spared": beyond["spared"]}
    sides = {
        COARSER: Body(coarse),
        POINTS: network,
        BLOCKS: replace(network, **blocks),
        THICK: replace(network, **beyond),
    }
    errors = {name: 100.0 * (measured(side) / truth - 1.0) for name, side in sides.items()}
    return Compared(slenderness, truth, errors)
