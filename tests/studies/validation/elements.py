"""The error of both elements on coarse meshes, and the order in which it falls: `make elements`.

python -m tests.studies.validation.elements FOLDER
"""

import sys
from functools import cache
from math import isnan, log2, nan
from pathlib import Path

from tests.studies.tables import head, line, tell
from tests.studies.validation.problem import NOISE
from tests.studies.validation.scenes import FINEST, SCENES

ELEMENTS = ("cubic", "classical")
MESHES = (1, 2, 3, 4, 6, 12)
FINER = 24  # for the order only
HEAD = ("error in % with so many elements a wall", "element", *map(str, MESHES), "order")
SMALL, LARGE = 1e-4, 999.0  # %
NOTES = f"""\
t/L: thickness / length of a wall; then how far it is shortened, pressed or turned, and the error is
that of the force or moment which this takes. "none": no limit point. Order: slope of the error
between the two finest of 3, 6, 12 and {FINER} elements that are above round-off; "-": the error
changes its sign between them. Truth: exact rods by collocation; the elastica for cantilevers; with
contact {FINEST} of our elements, which overstates the order.

The order of the cubic element is 4 where walls are slender and the path is smooth. Otherwise:

- Stout walls: a part of the error is of second order, and proportional to the axial strain P / Y A;
  with n elements in the clamped column, by 5 %, it is about -3 P / (Y A n^2).
- Walls that are bent but cannot come nearer (crosses, the cell between hinges) are pulled taut, and
  bend near their ends only: about ten elements are needed before the order is seen.
- With contact, where nodes touch one after another, the error falls irregularly and slowly.

One element does not buckle between clamped ends; the classical one does not between hinges either.
"""


@cache
def truth(scene):
    """The reference of a scene, found once."""
    return scene.truth(scene)


@cache
def errors(scene, element):
    """Relative errors by mesh, found once; NaN where there is nothing to measure."""
    return {n: scene.value(n, element) / truth(scene) - 1.0 for n in (*MESHES, FINER)}


def order(errors):
    """Slope of the error over the mesh in the finest pair that is above round-off.

    NaN if there is none, or if the error changes its sign between the two.
    """
    for n in (FINER // 2, FINER // 4, FINER // 8):
        coarse, fine = errors[n], errors[2 * n]
        if abs(fine) > NOISE:
            return log2(coarse / fine) if coarse * fine > 0.0 else nan
    return nan


def percent(error):
    """A relative error in % as text: two digits, one if it is small."""
    value = 100.0 * error
    if isnan(value):
        return "none"
    if abs(value) >= LARGE:
        return f"> {LARGE:.0f}"
    if abs(value) < SMALL:
        return f"< {SMALL:g}"
    if abs(value) >= 10.0:
        return f"{value:+.0f}"
    return f"{value:+.1g}" if abs(value) < 10.0 * SMALL else f"{value:+.2g}"


def rows(scene):
    """Rows of a scene: one for each element."""
    for element in ELEMENTS:
        found = errors(scene, element)
        slope = order(found)
        shown = [percent(found[n]) for n in MESHES]
        yield [scene.name, element, *shown, "-" if isnan(slope) else f"{slope:.2f}"]


def table():
    """Lines, each as soon as its scene is solved."""
    yield from head(HEAD)
    for scene in SCENES:
        yield from map(line, rows(scene))
    yield f"\n{NOTES}"


def main(folder):
    """Print the lines as they are found; write them to a folder."""
    tell(table(), folder / "elements.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
