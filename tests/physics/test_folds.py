"""Walls that fold: the answer does not depend on the number of elements of a wall.

Walls of cheetah, whose stress rises little beyond 20 % strain, between joints that are points:
their elements may be as short as a sixth of the thickness. Folds end where faces of a wall meet.
"""

import pytest

from sweep.config.case import Case
from tests.support.designs.scenes import is_sound, run, unbalanced


def crushed(kind, elements, **material):
    """4 x 3 cells, at half their height."""
    return run(Case.of(
        lattice=dict(
            kind=kind, cells_x=4, cells_y=3, width=0.024, height=0.015, depth=0.015,
            nodes_per_wall=elements - 1, wall_thickness=0.8e-3,
        ),
        loading=dict(strain=0.5),
        material=dict(name="cheetah", **material),
        solver=dict(joints="points"),
    ))  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "apart", "greatest"), [("diamond", 0.005, 0.571), ("triangle", 0.05, 1.497)]
)
def test_folds_are_as_far_bent_on_any_mesh(kind, apart, greatest):
    coarse, fine = crushed(kind, 8), crushed(kind, 16)
    for result in (coarse, fine):
        assert is_sound(result)
        assert unbalanced(result.history) < 1e-5
    energies = [result.summary["absorbed_energy_J"] for result in (coarse, fine)]
    assert energies[1] == pytest.approx(energies[0], rel=apart)
    strains = [result.summary["greatest_fibre_strain"] for result in (coarse, fine)]
    assert strains[1] == pytest.approx(greatest, rel=0.02)
    assert strains[1] < 1.2 * strains[0]


def test_a_wall_that_relaxes_folds():
    """Its energy is accounted for: the stop is elastic."""
    result = crushed("triangle", 12, loss=0.4)
    assert is_sound(result)
    assert result.summary["greatest_fibre_strain"] > 1.2
    assert unbalanced(result.history) < 1e-5
