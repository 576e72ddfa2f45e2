"""Decides whether a specimen was pulled or pressed. Machines often record compression as positive.

The stiffness of pulled printed TPU falls from the first point on, the stiffness of pressed rubber
grows, by a factor 1 + 2 b e / a of a parabola s = a e + b e^2 through the first loading.
"""

import re
from collections.abc import Iterable

import numpy as np

from sweep.array_types import Floats
from sweep.numbers import text_in

SIGNS = {"pulled": (1.0, 1.0), "pressed": (-1.0, -1.0)}
"""Signs of strain and stress in a test."""
PRESSED = re.compile(r"compress|stauch|druckversuch|druckspannung|écrasement", re.IGNORECASE)
PULLED = re.compile(r"tensile|tension test|zugversuch|traction", re.IGNORECASE)
GROWTH = 0.1  # growth of the stiffness in the first loading from which pulling is doubtful
UP_TO = 0.3  # strain: beyond it pulled rubber becomes stiffer again


def stated_test(texts: Iterable[str]) -> str | None:
    """The test that a file states, "pulled" or "pressed"; None if it states neither, or both."""
    words = "\n".join(texts)
    tests = [
        word for word, sign in (("pulled", PULLED), ("pressed", PRESSED)) if sign.search(words)
    ]
    return tests[0] if len(tests) == 1 else None


def directed(strain: Floats, stress: Floats, test: str) -> tuple[Floats, Floats]:
    """Strain and stress (n,) with the signs of a test: both negative if pressed."""
    sides = sides_of(strain, stress)
    sign, _ = SIGNS[test]
    return sign * sides[0] * strain, sign * sides[1] * stress


def sides_of(strain: Floats, stress: Floats) -> tuple[float, float]:
    """The signs of strain and stress (n,), from the first row to the greatest strain."""
    far = int(np.argmax(np.abs(strain - strain[0])))
    side, other = (1.0 if values[far] >= values[0] else -1.0 for values in (strain, stress))
    return side, other


def doubt(strain: Floats, stress: Floats, stated: str | None, to_scale: bool) -> str | None:
    """Why it cannot be decided how a specimen was tested; None if it can.

    stated: the test that the file states, see `stated_test`. to_scale: false if the strains are
    known only up to a factor.
    """
    sides = sides_of(strain, stress)
    if stated == "pressed" or (stated and sides[0] != sides[1]):
        return None
    if sides[0] != sides[1]:
        return "force and travel, or stress and strain, have opposite signs"
    if sides == SIGNS["pressed"]:
        return "the file has words of pulling, and negative numbers" if stated else None
    growth = _growth(np.abs(strain - strain[0]), np.abs(stress - stress[0]), to_scale)
    if stated or growth <= GROWTH:
        return None
    return (
        f"the numbers are positive, but the stiffness grows by {text_in(growth, '%', 2)} in the "
        "first loading, as of a puck, not of a printed strip"
    )


def _growth(strain: Floats, stress: Floats, to_scale: bool) -> float:
    """Relative growth of the stiffness in the first loading."""
    turn = int(np.argmax(strain)) + 1
    first, reached = strain[:turn], stress[:turn]
    if to_scale:
        first, reached = first[first <= UP_TO], reached[first <= UP_TO]
    if first.size < 3 or first[-1] <= 0.0:
        return 0.0
    share = first / first.max()
    (slope, bend), *_ = np.linalg.lstsq(np.column_stack([share, share**2]), reached, rcond=None)
    return float(2.0 * bend / slope) if slope > 0.0 else np.inf
