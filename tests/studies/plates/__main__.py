"""Shells against the theory of plates, by the number of quads across a plate, strip or wall.

Run by `make plates`, which prints the table of kernels/README.md in full.
"""

import sys

import numpy as np

from tests.studies.plates import buckled, joints, square, strip

MESHES = (4, 6, 8, 12, 16)


def rows():
    """Yield the measured quantity, the exact number, and a function of the number of quads."""
    for sides, ends, exact in square.BUCKLING:
        yield (
            f"k, sides {sides}, ends {ends}",
            exact,
            lambda n, e=(sides, ends): square.factor(n, *e),
        )
    for thickness in (0.1, 0.2):
        yield (
            f"knock-down by shear, t/b = {thickness:g}",
            square.mindlin(thickness),
            lambda n, t=thickness: square.knock_down(n, t),
        )
    for edges, exact in square.PRESSURE:
        yield f"w D / (q b^4), {edges}", exact, lambda n, e=edges: square.pressed(n, e)
    yield "M L / (2 pi D b) of a rolled strip", 1.0, lambda n: strip.rolled(n)[0]
    for degrees in (20, 40, 60, 80):
        tip = np.radians(degrees)
        yield (
            f"height of an elastica, {degrees} degrees",
            strip.column(tip)[1],
            lambda n, tip=tip: strip.pushed(n, tip),
        )
    for thickness in (0.05, 0.1, 0.2):
        yield (
            f"critical strain of a strip, t/l = {thickness:g}",
            1.0 - strip.exact_stretch(thickness),
            lambda n, t=thickness: 1.0 - strip.critical_stretch(n, t),
        )
    for kind in (joints.TUBE, joints.X_JOINT, joints.Y_JOINT):
        yield f"k, {kind}, t/l = 0.025", 4.0, lambda n, kind=kind: joints.factor(kind, n)
    yield "half wave of a long plate over its width", 1.0, buckled.wave
    for sides, exact in buckled.LEFT.items():
        yield (
            f"stiffness left after buckling, sides {sides}",
            exact,
            lambda n, sides=sides: buckled.left(n, sides),
        )


def main():
    """Write one line for each number."""
    heads = "".join(f"{f'{n} quads':>10}" for n in MESHES)
    sys.stdout.write(f"{'':44}{'exact':>10}{heads}\n")
    for name, exact, found in rows():
        cells = "".join(f"{100 * (found(n) / exact - 1):+9.2f}%" for n in MESHES)
        sys.stdout.write(f"{name:44}{exact:10.5g}{cells}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
