"""An effective material made by hand, with round numbers."""

from math import inf

import numpy as np

from sweep.effective.material import EffectiveMaterial

CARD = EffectiveMaterial(
    name="square",
    material="ninjaflex",
    angle=0.0,
    stiffness=np.diag([2e6, 1e6, 5e4]),
    modulus_3=3e6,
    shear_13=6e5,
    shear_23=5e5,
    poisson_of_walls=0.45,
    buckling=(6.41e3, inf),
    relative_density=0.154,
    density=183.0,
    wall_thickness=0.8e-3,
    period=(4e-3, 5e-3),
)
