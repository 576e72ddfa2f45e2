"""Derives the tension of a material whose compression is known, by an incompressible hyperelastic
law.

Mooney and Rivlin, nominal stress over stretch s, with both constants 0 or more, so that the stress
rises with every stretch:

    P(s) = 2 (C1 + C2 / s) (s - 1 / s^2)

C2 = 0 is the neo-Hookean law. Two constants follow a puck from 0 to 40 % compression if it is a
rubber; a printed TPU that yields softens more than any such law, and cannot be fitted.
"""

from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats

FOLLOWED = 0.02  # rms misfit over the greatest stress: a law with a larger one is not used
LEAST = 0.1  # strain: a shorter record does not distinguish the two constants


class Rubber(NamedTuple):
    """The constants 2 C1 and 2 C2 in Pa."""

    first: float
    second: float

    def at(self, strain: Floats) -> Floats:
        """Nominal stress (n,) in Pa at nominal strains (n,), tension positive."""
        stresses: Floats = _terms(strain) @ np.array(self)
        return stresses


def rubber(strain: Floats, stress: Floats) -> Rubber | None:
    """The law fitted to a compression by least squares; None if no such law fits.

    strain, stress (n,): nominal, both positive in compression, without the origin.
    """
    if strain[-1] < LEAST:
        return None
    from scipy.optimize import nnls

    constants, apart = nnls(-_terms(-strain), stress)
    if apart > FOLLOWED * stress.max() * np.sqrt(stress.size):
        return None
    return Rubber(*constants.tolist())


def _terms(strain: Floats) -> Floats:
    """Stresses (n, 2) of unit constants."""
    stretch = 1.0 + strain
    first = stretch - 1.0 / stretch**2
    return np.column_stack([first, first / stretch])
