"""Arms of joints with any openings: their compliance beyond beams, C of `arms`, with triangles.

The sides of two neighbouring arms with an opening g between them meet at t/2 cot(g/2) along both:
at a re-entrant corner if g < 180 degrees, in a mitre if more.

python -m tests.studies.continuum.joint_compliance prints the table sweep/scene/joints.csv in ten
minutes; with the word glued, the contents of sweep/scene/joints_on_glued_rows.csv, in ten seconds.
"""

import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import Delaunay
from skfem import Basis, BilinearForm, ElementTriP4, ElementVector, FacetBasis, LinearForm, MeshTri
from skfem.helpers import ddot, div, sym_grad

from tests.studies.continuum.arms import TRACTIONS, axes
from tests.studies.continuum.press import factor

REACH = 3.0  # of an arm beyond its last corner, thicknesses: exp(-4.2 REACH) of the stress is left
ROWS, LEVELS = 4, 14  # triangles to a thickness; halvings of those at re-entrant corners
NEAR = 1e-9  # of coordinates


@BilinearForm
def sheared(u, v, _):
    """The part of the shear modulus."""
    return 2.0 * ddot(sym_grad(u), sym_grad(v))


@BilinearForm
def swollen(u, v, _):
    """The part of the first Lamé constant of plane stress."""
    return div(u) * div(v)


def stiffness(one, other, poisson):
    """Matrix of modulus 1, from the matrices of the shear modulus and of the first Lamé
    constant.
    """
    return one / (2.0 * (1.0 + poisson)) + other * poisson / (1.0 - poisson**2)


def beam(length, poisson):
    """Compliance of a beam of thickness 1 under (N, V, M) at its end; Timoshenko's, k = 5/6."""
    shear = 2.4 * (1.0 + poisson) * length + 4.0 * length**3
    bend = -6.0 * length**2
    return np.array([[length, 0.0, 0.0], [0.0, shear, bend], [0.0, bend, 12.0 * length]])


@dataclass
class Star:
    """A solid joint of modulus and depth 1; openings (n,): round the joint, degrees.

    thickness (n,): of the arms, 1 unless given.
    """

    openings: tuple
    thickness: tuple = ()

    def __post_init__(self):
        gap = np.radians(self.openings)
        gap *= 2.0 * np.pi / gap.sum()  # corners that rounding doubles would be slits
        self.angles = np.concatenate([[0.0], np.cumsum(gap)[:-1]])
        self.wide = np.array(self.thickness or np.ones(len(gap)))
        after = np.roll(self.wide, -1)
        # how far along an arm the corner to its left is, and to its right
        self.port = 0.5 * (after + self.wide * np.cos(gap)) / np.sin(gap)
        self.starboard = np.roll(0.5 * (self.wide + after * np.cos(gap)) / np.sin(gap), 1)
        self.length = max(self.port.max(), self.starboard.max()) + REACH * self.wide.max()
        self.along, self.left = np.array([axes(angle) for angle in self.angles]).swapaxes(0, 1)

    def mesh(self):
        """Triangles between rows of points along the arms, smaller towards re-entrant corners."""
        rows, corners = [], []
        for i, wide in enumerate(self.wide):
            for o in np.linspace(-0.5, 0.5, ROWS + 1):
                start = 2.0 * abs(o) * (self.port if o > 0.0 else self.starboard)[i]
                x = np.linspace(start, self.length, round((self.length - start) * ROWS) + 1)
                rows.append(x[:, None] * self.along[i] + o * wide * self.left[i])
            if self.openings[i] < 180.0:
                corners.append(rows[-1][0])
        points = np.concatenate(rows)
        points = points[np.unique(points.round(9) + 0.0, axis=0, return_index=True)[1]]
        triangles = Delaunay(points).simplices.T
        inside = self._within(points[triangles].mean(axis=0))
        mesh = MeshTri(points.T.copy(), triangles[:, inside].copy())
        for _ in range(LEVELS):
            at = [np.argmin(np.hypot(*(mesh.p - corner[:, None]))) for corner in corners]
            mesh = mesh.refined(np.flatnonzero(np.isin(mesh.t, at).any(axis=0)))
        return mesh

    def _within(self, points):
        """Which points are in an arm, from the lines between the centre and its corners on."""
        found = np.zeros(len(points), bool)
        for i, wide in enumerate(self.wide):
            x, o = self.along[i] @ points.T, self.left[i] @ points.T / wide
            start = 2.0 * np.abs(o) * np.where(o > 0.0, self.port[i], self.starboard[i])
            found |= (np.abs(o) < 0.5 - NEAR) & (x > start - NEAR) & (x < self.length - NEAR)
        return found

    def loads(self, mesh, element):
        """Nodal forces of (N, V, M / t) of every arm at the centre, (3 n, dofs)."""
        middle, found = mesh.p[:, mesh.facets].mean(axis=1), []
        for i, wide in enumerate(self.wide):
            along, left = self.along[i], self.left[i]
            at = np.isclose(along @ middle, self.length) & (np.abs(left @ middle) < 0.5 * wide)
            end = FacetBasis(mesh, element, facets=np.flatnonzero(at))
            o = np.einsum("i,i...->...", left, np.asarray(end.global_coordinates())) / wide
            n, v, m = (
                LinearForm(lambda u, w, way=way: w.f * (way[0] * u[0] + way[1] * u[1])).assemble(
                    end, f=traction(o) / wide
                )
                for traction, way in zip(TRACTIONS, (along, left, along), strict=True)
            )
            found += [n, v - self.length / wide * m, m]
        return np.array(found)

    @cached_property
    def _assembled(self):
        element, mesh = ElementVector(ElementTriP4()), self.mesh()
        basis = Basis(mesh, element)
        away = mesh.p - mesh.p[:, :1]
        far = np.argmax(np.hypot(*away))
        across = np.argmin(np.abs(away[:, far]))  # of the line between the two nodes that are held
        held = [*basis.nodal_dofs[:, 0], basis.nodal_dofs[across, far]]
        free = np.setdiff1d(np.arange(basis.N), held)
        matrices = (form.assemble(basis)[free][:, free] for form in (sheared, swollen))
        return *matrices, self.loads(mesh, element)[:, free]

    def beyond(self, poisson):
        """C of all arms, (n, 3, n, 3), for (N, V, M / t) in balance."""
        one, other, loads = self._assembled
        matrix = stiffness(one, other, poisson)
        form = (loads @ factor(matrix).solve(loads.T.copy())).reshape(2 * (len(self.wide), 3))
        for i, wide in enumerate(self.wide):
            form[i, :, i] -= beam(self.length / wide, poisson)
        return form


@dataclass
class Yield:
    """C of one arm of a joint, from the form of all."""

    star: Star
    poisson: float

    def __post_init__(self):
        self.form = self.star.beyond(self.poisson)
        self.pull = np.linalg.pinv(self.star.along.T)
        twice = 2.0 * self.star.angles
        self.turns = np.array([np.cos(twice), np.sin(twice)])

        affine = np.vstack([np.ones_like(twice), self.turns])
        _, size, ways = np.linalg.svd(affine - affine @ self.star.along @ self.pull.T)
        self.tensions = ways[: len(size)][size > 1e-6]  # a + b cos 2 (angle - c), in balance

    def sheared(self, moments):
        """Resultants (..., n, 3): shears in the ratios of moments, least axial forces."""
        axial = -moments @ self.star.left @ self.pull.T
        return np.stack([axial, moments, 0.0 * moments], axis=-1)

    def sway(self, moments, nm=0.0, nv=0.0):
        """MM, MV, VV, NN, NM, NV of an arm: means over moments (k, n) and over tensions.

        The shears are in the ratios of the moments. nm, nv (n,): of the arms, if they have any; VV
        and MV exclude the compliance under the axial forces that balance the shears.
        """
        turned = np.zeros((*moments.shape, 3))
        turned[..., 2] = moments
        both = np.stack([turned, self.sheared(moments)])
        share = np.einsum("akix,ixjy,bkjy->ab", both, self.form, both)
        axial, tensions = both[1, ..., 0], self.tensions
        nn = np.einsum("ki,ij,kj", tensions, self.form[:, 0, :, 0], tensions)
        nn /= max(len(tensions), 1)
        share[0, 1] -= np.sum(nm * moments * axial)
        share[1, 1] -= np.sum(nn * axial**2 + 2.0 * nv * moments * axial)
        mm, mv, vv = share[[0, 0, 1], [0, 1, 1]] / np.sum(moments**2)
        return np.array([mm, mv, vv, nn, 0.0, 0.0])

    def arms(self):
        """C of an arm of each place: (MM, MV, VV, NN, NM, NV).

        all: mean over the turns of the arms in affine deformations. axis, side: of three arms, the
        third and the first two, whose C is exact in the sways (1, -1, 0) and (-1, -1, 2) and under
        the tension in balance. Mirrored arms have opposite NM and NV: these are of the first arm.
        """
        yield "all", self.sway(self.turns - self.turns.mean(axis=1, keepdims=True))
        if len(self.star.wide) == 3:
            even, odd = np.array([[1.0, -1.0, 0.0]]), np.array([[-1.0, -1.0, 2.0]])
            (pull,) = self.tensions
            coupled = np.einsum("i,ijy->jy", pull, self.form[:, 0]) / pull[:2].sum()
            nm, nv = coupled[:, 2] @ even[0], np.sum(coupled * self.sheared(even)[0])
            side, both = (self.sway(way, nm * even[0], nv * even[0]) for way in (even, odd))
            yield "axis", 1.5 * both - 0.5 * side
            yield "side", np.array([*side[:4], nm, nv])


def on_glued_row(openings, poisson):
    """C of the second arm, upright on a row along x whose outer face is glued, (3, 3)."""
    star = Star(openings)
    element, mesh = ElementVector(ElementTriP4()), star.mesh()
    basis = Basis(mesh, element)
    face = mesh.facets_satisfying(lambda x: np.isclose(x[1], -0.5))
    free = np.setdiff1d(np.arange(basis.N), basis.get_dofs(facets=face).all())
    one, other = (form.assemble(basis)[free][:, free] for form in (sheared, swollen))
    loads = star.loads(mesh, element)[3:6, free]
    matrix = stiffness(one, other, poisson)
    return loads @ factor(matrix).solve(loads.T.copy()) - beam(star.length, poisson)


GLUED = (90.0, 90.0, 180.0), (90.0, 270.0)
ENTRIES = {"MM": (2, 2, 2), "MV": (1, 2, 1), "VV": (1, 1, 1), "NN": (0, 0, 2)}
"""Entries of C over (N, V, M), and up to which power of nu' the table has them."""

KINDS = {  # openings by the angle, and its range
    "V": (lambda g: (g, 360 - g), (30, 175)),
    "Y": (lambda g: (g, 180 - g / 2, 180 - g / 2), (90, 285)),
    "T": (lambda g: (180, g, 180 - g), (30, 90)),
    "X": (lambda g: (g, 180 - g, g, 180 - g), (20, 90)),
    "K": (lambda g: (90 - g / 2, g, 90 - g / 2, 180), (30, 130)),
    "5": (lambda g: (g, 90 - g / 2, 90 - g / 2, g, 180 - g), (30, 90)),
    "6": (lambda g: 2 * (g, 90 - g / 2, 90 - g / 2), (30, 90)),
}
ACUTE, STEPS = 40, (2.5, 5)  # degrees; steps of the table below and above
HEAD = """\
# What one arm of a joint yields beyond Timoshenko beams (k = 5/6) that meet in the centre, linear.
# Source: plane elasticity of the solid joint, python -m tests.studies.continuum.joint_compliance
# Energy: 1/(2 Y' depth) r.C r, r = (N, V, M/t), lengths in t. nu': Poisson's ratio of the plane.
# C: MM; MV - 1.2 nu'; VV + VV_nu nu'; and so on; NM does not depend on nu'. Between angles: linear.
# Openings round the joint, degrees, by the angle g, with h = (180 - g)/2:
#   V: g, 360 - g.  Y: g, 180 - g/2, 180 - g/2.  T: 180, g, 180 - g.  X: g, 180 - g, g, 180 - g.
#   K: h, g, h, 180.  5: g, h, h, g, 180 - g.  6: g, h, h, g, h, h.
# arm: all; or, more closely, axis (of Y and T: the arm opposite the first opening) and side.
# NM, NV: of the side arm with the first opening to its left; the other one has opposite signs.
kind,angle,arm,MM,MV,VV,NN,NM,NV,VV_nu,NN_nu,NV_nu"""


def matrix(values):
    """C of an arm, (3, 3) over (N, V, M)."""
    mm, mv, vv, nn, nm, nv = values
    return np.array([[nn, nv, nm], [nv, vv, mv], [nm, mv, mm]])


def rows(kind, angle):
    """Lines of the table, (arm, values)."""
    star = Star(KINDS[kind][0](angle))
    for (arm, one), (_, other) in zip(
        Yield(star, 0.0).arms(), Yield(star, 0.4).arms(), strict=True
    ):
        slope = (other - one) / 0.4
        yield arm, np.array([*one, *slope[[2, 3, 5]]])


def print_glued(out):
    """Print the compliance of arms on glued rows, fitted for Poisson's ratios of the plane up to
    0.95.
    """
    poisson = np.linspace(0.0, 0.95, 5)
    for openings in GLUED:
        forms = np.array([on_glued_row(openings, nu) for nu in poisson])
        for entry, (i, j, power) in ENTRIES.items():
            fit = np.zeros(3)
            fit[: power + 1] = np.polyfit(poisson, forms[:, i, j], power)[::-1]
            angles = " ".join(f"{angle:g}" for angle in openings)
            out.write(f"{angles},{entry}," + ",".join(f"{c:.3f}" for c in fit + 0.0) + "\n")


def main(out):
    """Print the table."""
    out.write(HEAD + "\n")
    for kind, (_, (low, high)) in KINDS.items():
        for angle in (
            *np.arange(low, ACUTE, STEPS[0]),
            *range(max(low, ACUTE), high + 1, STEPS[1]),
        ):
            for arm, values in rows(kind, angle):
                cells = ",".join(f"{value + 0.0:.3f}" for value in values.round(3))
                out.write(f"{kind},{angle:g},{arm},{cells}\n")
            out.flush()


if __name__ == "__main__":
    print_glued(sys.stdout) if sys.argv[1:] == ["glued"] else main(sys.stdout)
