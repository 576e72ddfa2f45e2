"""A panel of 6 x 3 square cells as a solid under a round striker, kept in indented.csv.

python -m tests.studies.continuum.indented computes it in some minutes and prints the file; with the
word "table", it compares our network of walls with the file. The striker is a circle that pushes
out the parts of the solid inside it, with a spring as stiff as a layer of rubber of `LAYER` walls;
walls do not touch one another yet. The panel is glued to its base.
"""

import csv
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import csc_array

from tests.studies.continuum.grid import Grid
from tests.studies.continuum.press import StuckError
from tests.studies.continuum.rubber import RUBBERS
from tests.studies.continuum.solids import MODULUS, POISSON

FILE = Path(__file__).with_name("indented.csv")
HEAD = """\
# A round striker on a panel of 6 x 3 square cells as a solid body: force over stroke / height.
# Source: python -m tests.studies.continuum.indented, quadratic finite elements in plane stress
# 25 x 12.5 mm over centre lines, depth 12 mm, walls of 0.1 L, L = 12.5 mm / 3, bow 0.01 t, glued to
# its base; neo-Hookean rubber, Y = 12 MPa, nu = 0.48; striker of 5 mm without friction, beside a
# joint (0.52 of the width) and between two (7/12). across: elements through a wall.
at,across,strain,force_N
"""
CELLS, ROWS = 6, 3
WATCHED = (0.01, 0.02, 0.04, 0.06, 0.08, 0.1)
RADIUS, LAYER = 5.0, 0.01
PLACES, MESHES = (0.52, 7.0 / 12.0), (2, 3)
STRAINS = 0.005 * np.arange(1, 23)


class Circle:
    """A circle that pushes the surface of a solid back. tip (2,): its lowest point, mm."""

    def __init__(self, solid, stiffness, tip):
        basis = solid.basis
        facets = solid.mesh.boundary_facets()
        ends, middle = basis.mesh.facets[:, facets], basis.facet_dofs[0, facets]
        one, other = basis.nodal_dofs[0][ends]
        span = np.linalg.norm(solid.points[one] - solid.points[other], axis=1)
        self.points, self.size, self.tip = solid.points, solid.size, np.array(tip)
        self.spring = np.zeros(len(solid.points))  # Simpson's rule
        for nodes, share in ((one, 1.0), (other, 1.0), (middle, 4.0)):
            np.add.at(self.spring, nodes, stiffness * share / 6.0 * span)

    def _inside(self, u):
        """Nodes inside, the way out (k, 2), how far (k,), and their distance from the axis."""
        out = self.points + u.reshape(-1, 2) - self.tip - [0.0, RADIUS]
        away = np.linalg.norm(out, axis=1)
        nodes = np.flatnonzero((away < RADIUS) & (self.spring > 0.0))
        return nodes, out[nodes] / away[nodes, None], RADIUS - away[nodes], away[nodes]

    def energy(self, u):
        """Energy of the springs, mJ."""
        nodes, _, depth, _ = self._inside(u)
        return 0.5 * float(self.spring[nodes] @ depth**2)

    def gradient(self, u):
        """Gradient of the energy, N."""
        nodes, out, depth, _ = self._inside(u)
        whole = np.zeros((len(self.points), 2))
        whole[nodes] = -(self.spring[nodes] * depth)[:, None] * out
        return whole.ravel()

    def hessian(self, u):
        """Hessian of the energy: n n^T - (depth / distance) (1 - n n^T)."""
        nodes, out, depth, away = self._inside(u)
        across = out[:, :, None] * out[:, None, :]
        block = across - (depth / away)[:, None, None] * (np.eye(2) - across)
        block *= self.spring[nodes, None, None]
        at = 2 * nodes[:, None, None] + np.arange(2)[:, None]
        row, column = np.broadcast_arrays(at, at.swapaxes(1, 2))
        places = row.ravel(), column.ravel()
        return csc_array((block.ravel(), places), shape=(self.size, self.size))


def mesh(across):
    """The walls of the panel, in rectangles."""
    from skfem import MeshQuad

    up, along = grid(ROWS, across), grid(CELLS, across)
    full = MeshQuad.init_tensor(along.lines(), up.lines())
    centre = full.p[:, full.t].mean(axis=1)
    off = np.abs(centre - up.pitch * np.round(centre / up.pitch))
    walls = full.restrict(np.flatnonzero(off.min(axis=0) < 0.5 * up.thickness))
    shift = up.bow * up.thickness * np.sin(np.pi * walls.p[1] / up.width)
    return MeshQuad(walls.p + np.array([shift, 0.0 * shift]), walls.t)


def grid(cells, across=2):
    """A grid of the pitch of the panel."""
    pitch = 12.5 / 3.0
    return Grid(cells=cells, width=cells * pitch, thickness=0.1 * pitch, across=across)


class Indented:
    """The panel under a striker ``at`` a share of its width; solved as in `press.Press`."""

    def __init__(self, at, across):
        from tests.studies.continuum.press import Press
        from tests.studies.continuum.solid import Solid

        shape = grid(ROWS, across)
        body = Solid(mesh(across), RUBBERS["stress"](MODULUS, POISSON), shape.depth)
        self.height, self.top = shape.width, body.points[:, 1].max()
        stiffness = MODULUS * shape.depth / (LAYER * shape.thickness)
        self.circle = Circle(body, stiffness, (at * CELLS * shape.pitch, self.top))
        self.press = Press(body, self.height)
        self.press.terms.append(self.circle)
        low = np.flatnonzero(np.isclose(body.points[:, 1], body.points[:, 1].min()))
        held = (2 * low[:, None] + np.arange(2)).ravel()
        self.press.free = np.setdiff1d(np.arange(body.size), held)
        rest = body.hessian(np.zeros(body.size))
        self.press.damper = rest[self.press.free][:, self.press.free].diagonal()

    def rows(self, strains):
        """Strain and force (N) of rising strokes / height."""
        u, now = np.zeros(self.press.size), 0.0
        for strain in strains:
            by = strain - now
            while now < strain - 1e-12:
                by = min(by, strain - now)
                try:
                    u, now = self._settled(u, now + by), now + by
                except StuckError:
                    by *= 0.5
                    if by < 1e-5:
                        raise
            yield strain, float(self.circle.gradient(u)[1::2].sum())

    def _settled(self, u, strain):
        self.circle.tip[1] = self.top - strain * self.height
        return self.press.settle(u)


def stored():
    """Strains and forces (2, k) by place and elements through a wall."""
    with FILE.open(encoding="utf-8") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    curves = {}
    for line in lines:
        row = float(line["strain"]), float(line["force_N"])
        curves.setdefault((round(float(line["at"]), 4), int(line["across"])), []).append(row)
    return {key: np.array(rows).T for key, rows in curves.items()}


def network(at, pieces):
    """Strain and force (N) of the panel as a network of ``pieces`` elements a wall."""
    from sweep.config.case import Case
    from tests.studies.continuum.network import MM, material
    from tests.support.converged import converged

    up = grid(ROWS)
    size = dict(width=CELLS * up.pitch * MM, height=up.width * MM, depth=up.depth * MM)
    case = Case.of(
        lattice=size
        | dict(cells_x=CELLS, cells_y=ROWS, wall_thickness=up.thickness * MM, imperfection=up.bow)
        | dict(kind="square", nodes_per_wall=pieces - 1),
        material=material(RUBBERS["stress"](MODULUS, POISSON), "stress", "section"),
        loading=dict(mode="displacement", strain=STRAINS[-1], unload=False, platen="glued")
        | dict(striker="round", striker_radius=RADIUS * MM, striker_at=at),
        contact=dict(friction=0.0),
        solver=dict(load_steps=300),
    )
    history = converged(case).history
    return history["strain"], history["reaction_top_N"]


def compare():
    """Print forces of the finest solid, and the errors of the coarser one and of networks, %."""
    out, coarse, fine = sys.stdout, *MESHES
    out.write("| at | strain, % | N | coarser solid | 3 elements a wall | 8 | 16 |\n|" + "---|" * 7)
    for at in PLACES:
        key = round(at, 4)
        sides = [stored()[key, coarse], *(network(at, pieces) for pieces in (3, 8, 16))]
        for strain in WATCHED:
            truth = np.interp(strain, *stored()[key, fine])
            errors = [f"{100.0 * (np.interp(strain, *side) / truth - 1.0):+.1f}" for side in sides]
            cells = f"{100.0 * at:.3g} %", f"{100.0 * strain:g}", f"{truth:.3g}", *errors
            out.write(f"\n| {' | '.join(cells)} |")
    out.write("\n")


def main():
    """Print the rows of both places by both meshes."""
    sys.stdout.write(HEAD)
    for at in PLACES:
        for across in MESHES:
            for strain, force in Indented(at, across).rows(STRAINS):
                sys.stdout.write(f"{at:.4f},{across},{strain:.4g},{force:.6g}\n")
                sys.stdout.flush()


if __name__ == "__main__":
    compare() if sys.argv[1:] == ["table"] else main()
