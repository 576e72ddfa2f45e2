"""The law of a material point: which of its laws acts, and that it keeps the state of that one."""

import numpy as np
import pytest

from kernels.laws.relaxation import BRANCHES
from kernels.laws.yielding import STATE
from sweep.scene.material import law_in_stretch
from tests.support.designs.tables import material_with
from tests.support.materials.memory import follow, there_and_back, virgin

NUMBERS = {"modulus": 2e9, "density": 1240.0, "poisson": 0.35}
LIMIT = 5e7
SIZES = {
    "elastic": (NUMBERS, 0),
    "relaxing": (NUMBERS | {"relaxation_times": (1.0,), "relaxation_shares": (0.5,)}, BRANCHES + 2),
    "softening": ({"softening_r": 2.0, "softening_m": 1e5}, BRANCHES),
    "yielding": (NUMBERS | {"yield_stress": LIMIT}, STATE),
}


@pytest.mark.parametrize("kind", SIZES)
def test_a_point_keeps_the_numbers_of_what_acts(kind):
    given, size = SIZES[kind]
    assert law_in_stretch(material_with(**given), 1.0).state_size() == size


@pytest.mark.parametrize("kind", SIZES)
def test_what_acts_shows_in_a_cycle(kind):
    """Elastic walls return all work at once, the others lose some of it."""
    law = law_in_stretch(material_with(**SIZES[kind][0]), 1.0)
    path = follow(law, there_and_back(0.1, 100), 0.02)
    lost = path.dissipated[-1] / path.work[99]
    assert (lost > 0.05) == (kind != "elastic")
    assert path.gap < 2e-3
    if kind == "yielding":
        assert np.abs(path.stress).max() == pytest.approx(LIMIT, rel=1e-12)


def test_the_slope_at_rest_is_the_modulus_at_the_reference_time():
    for given, _ in SIZES.values():
        material = material_with(**given)
        law = law_in_stretch(material, 1.3)
        assert law.modulus == pytest.approx(1.3 * material.modulus)
    elastic = law_in_stretch(material_with(**NUMBERS), 1.3)
    assert elastic.respond(0.0, virgin(elastic), 0)[2] == pytest.approx(1.3 * 2e9)
