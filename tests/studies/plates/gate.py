"""A square tube of plates against the same tube of bricks: force and energy through buckling.

Run by `make plates_solid`. Pitch 4 mm, height 12 mm, walls of 0.4, 0.2 and 0.1 mm, neo-Hookean, Y =
67 MPa, bow of 0.02 thicknesses, no contact. Glued platens hold the plan and the height of the ends:
on their whole thickness ("clamped"), or of their mid-surface, which may lean ("hinged": the platen
"glued" of a case). Shortenings are multiples of the theoretical buckling strain of the walls, 4.386
(t / l)^2. The kink is where the tangents before and after it meet.
"""

import sys
from functools import cache

import numpy as np

from sweep.config.case import Case
from tests.studies.plates.tied import Platen
from tests.studies.plates.tube import CLAMPED, HINGED, SolidTube
from tests.support.converged import converged

MM = 1e-3
BUCKLING = 4.0 * np.pi**2 / 9.0
BEFORE, AFTER = (0.1, 0.5), (1.5, 2.0)  # shortenings through which the tangents go
SHORT = (0.1, 0.5, 0.75, *np.arange(4, 9) / 4.0, *np.arange(5, 9) / 2.0)
LONG = (*SHORT, 4.5, 5.0, 5.5, 5.75, 6.0, 6.25, 6.5)
THICK = (*SHORT[:8], 2.25, 2.5, 2.75, 3.0)
SHOWN = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0)
CASES = (  # thickness in mm, end, shortenings of buckling
    (0.1, CLAMPED, LONG),
    (0.1, HINGED, LONG),
    (0.2, CLAMPED, LONG),
    (0.2, HINGED, LONG),
    (0.4, CLAMPED, THICK),
    (0.4, HINGED, THICK),
)
PLATES = (6, 8, 12)  # quads a wall; no more than fit, which are as long as the wall is thick
PLATEN = {CLAMPED: "clamped", HINGED: "glued"}
FINER = {"longer": {"across": 6, "up": 15}, "both": {"through": 2, "across": 6, "up": 14}}


def strain(thickness, pitch=4.0):
    """Strain at which the walls buckle."""
    return BUCKLING * (thickness / pitch) ** 2


class Curve:
    """Shortenings over the shortening of buckling, force in N and stored energy in mJ."""

    def __init__(self, shortening, force, energy):
        self.shortening, self.force, self.energy = shortening, force, energy

    def at(self, shortening):
        """Force and energy."""
        return [np.interp(shortening, self.shortening, y) for y in (self.force, self.energy)]

    def kink(self):
        """Force where the tangents meet."""
        lines = []
        for near, far in (BEFORE, AFTER):
            low, high = self.at(near)[0], self.at(far)[0]
            slope = (high - low) / (far - near)
            lines.append((slope, low - slope * near))
        (a, b), (c, d) = lines
        return a * (d - b) / (a - c) + b

    def peak(self):
        """Shortening and force of the first peak, by a parabola; None if there is none."""
        falls = np.flatnonzero(np.diff(self.force) < 0.0)
        if not len(falls) or falls[0] == 0:
            return None
        near = slice(falls[0] - 1, falls[0] + 2)
        parabola = np.polyfit(self.shortening[near], self.force[near], 2)
        top = -0.5 * parabola[1] / parabola[0]
        return top, float(np.polyval(parabola, top))


def solid(thickness, ends, shortenings, **mesh):
    """Curve of the bricks."""
    tube = SolidTube(thickness, ends=ends, **mesh)
    rows = Platen(tube.build(), tube.driven).crush(strain(thickness) * np.array(shortenings)).rows
    at, force, energy = np.array(rows).T
    return Curve(at / strain(thickness), 4.0 * force, tube.copies * energy)


@cache
def plates(thickness, ends, last, n):
    """Curve of the plates, n quads a wall; ``last``: greatest shortening."""
    n = min(n, int(4.0 / thickness * (1.0 + 1e-9)))
    case = Case.of(
        lattice=dict(
            kind="square",
            cells_x=1,
            cells_y=1,
            width=4.0 * MM,
            height=4.0 * MM,
            depth=12.0 * MM,
            wall_thickness=thickness * MM,
            nodes_per_wall=n - 1,
            layers=3 * n,
            imperfection=0.02,
            symmetry="quarter",
        ),
        loading=dict(
            mode="displacement",
            direction="out_of_plane",
            strain=last * strain(thickness),
            platen=PLATEN[ends],
            unload=False,
        ),
        material=dict(modulus=67e6, stretch="linear", bend="linear", density=1180.0),
        contact=dict(model="none", friction=0.0),
        solver=dict(integrator="static", load_steps=round(20 * last)),
    )
    history = converged(case).history
    stored = 1e3 * (history["stretch_J"] + history["bend_J"])
    return Curve(history["strain"] / strain(thickness), history["reaction_top_N"], stored)


def lines(reference, others):
    """Numbers of a solid, and errors of other curves in percent."""
    for name, found in _numbers(reference).items():
        errors = (_numbers(curve).get(name, np.nan) / found - 1.0 for curve in others)
        yield f"{name:28}{found:10.4g}" + "".join(f"{100 * error:+10.1f}" for error in errors)


def _numbers(curve):
    found = {"force at the kink, N": curve.kink()}
    for shortening in SHOWN:
        if shortening <= curve.shortening[-1] + 1e-9:
            force, energy = curve.at(shortening)
            found[f"force at {shortening:g}, N"] = force
            found[f"energy to {shortening:g}, mJ"] = energy
    if peak := curve.peak():
        found["shortening at the peak"], found["force at the peak, N"] = peak
    return found


def main(out):
    """Print one table for each case, then the solid on a finer mesh."""
    for thickness, ends, shortenings in CASES:
        heads = "".join(f"{f'{n} quads':>10}" for n in PLATES)
        out.write(f"\nl/t = {4.0 / thickness:g}, {ends:18}{'solid':>10}{heads}, error in %\n")
        out.flush()
        found = solid(thickness, ends, shortenings)
        others = [plates(thickness, ends, shortenings[-1], n) for n in PLATES]
        out.write("\n".join(lines(found, others)) + "\n")
        out.flush()
    found = solid(0.2, CLAMPED, SHORT)
    for name, mesh in FINER.items():
        out.write(f"\nl/t = 20, clamped, solid of more bricks ({name}), error of the other in %\n")
        out.write("\n".join(lines(solid(0.2, CLAMPED, SHORT, **mesh), [found])) + "\n")
        out.flush()


if __name__ == "__main__":
    main(sys.stdout)
