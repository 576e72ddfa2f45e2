"""Moduli of a cubic material from its stiffness (6, 6), over strains 11, 22, 33, 23, 13, 12.

Shear strains are twice the components of the tensor. With the compliance S = C^(-1), Young's
modulus along the unit vector n is (J. Nye, Physical Properties of Crystals, 1957)

    1 / E(n) = S11 - 2 (S11 - S12 - S44 / 2) (n1^2 n2^2 + n2^2 n3^2 + n3^2 n1^2)

and G = C44 is the shear modulus in the planes of the axes.
"""

from typing import NamedTuple

import numpy as np

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""Components of a tensor, in the order of the rows of a stiffness."""


class Cubic(NamedTuple):
    """The three stiffnesses of a cubic material, in the units of its modulus."""

    c11: float
    c12: float
    c44: float

    @property
    def moduli(self):
        """E along [100], [110] and [111], and G."""
        low = self.c11 - self.c12
        s11 = (self.c11 + self.c12) / (low * (self.c11 + 2.0 * self.c12))
        unlike = 1.0 / low - 0.5 / self.c44  # S11 - S12 - S44 / 2
        along = [1.0 / (s11 - 2.0 * unlike * part) for part in (0.0, 1.0 / 4.0, 1.0 / 3.0)]
        return np.array([*along, self.c44])


NAMES = ("E[100]", "E[110]", "E[111]", "G")
"""Of the `Cubic.moduli`."""


def tensor(strain):
    """The tensor (3, 3) of six strains, half of the last three off its diagonal."""
    whole = np.zeros((3, 3))
    for value, (i, k) in zip(strain, PAIRS, strict=True):
        whole[i, k] = whole[k, i] = value if i == k else 0.5 * value
    return whole


def cubic(stiffness):
    """The `Cubic` nearest to a stiffness (6, 6), and the largest entry that a cubic one has not,
    over C11.
    """
    normal, shear = stiffness[:3, :3], stiffness[3:, 3:]
    of = Cubic(
        np.trace(normal) / 3.0, (normal.sum() - np.trace(normal)) / 6.0, np.trace(shear) / 3.0
    )
    exact = np.zeros((6, 6))
    exact[:3, :3] = of.c12
    np.fill_diagonal(exact, [of.c11] * 3 + [of.c44] * 3)
    return of, np.abs(stiffness - exact).max() / of.c11
