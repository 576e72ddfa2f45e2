"""An endless lattice: its invariances, its book, its derivatives."""

from unittest.mock import patch

import numpy as np
import pytest

from kernels.solve import outcomes
from sweep.scene import periodic
from sweep.simulation.simulate import simulate
from tests.support.designs.periods import (
    PITCH,
    L,
    assert_alike,
    assert_derivatives,
    assert_solved,
    crushed,
    cut_elsewhere,
    lattice_of,
    pressed,
)
from tests.support.designs.scenes import is_sound, trapezoid, unbalanced
from tests.support.kernels.solving import descend, whole


def cut_at(case, cut=(0.0, 0.0), wave=None):
    """Result with another corner of the period, and the imperfection of a period of two cells."""
    lattice = case.lattice
    wave = wave or lattice.height

    def shift(lattice, y):
        return 0.05 * lattice.wall_thickness * np.cos(2 * np.pi * (y + cut[1]) / wave)

    with patch.object(periodic, "imperfection", shift), cut_elsewhere(cut):
        return simulate(case)


def density(result, name):
    """A column of the history for each m^3 of lattice."""
    return result.history[name] / (result.summary["width_m"] * result.summary["height_m"])


CRUSHES = {"hex": 0.2, "kagome": 0.08, "reentrant": 0.12}  # thickness / pitch


@pytest.mark.parametrize(
    ("kind", "friction"), [("hex", 0.3), ("kagome", 0.0), ("reentrant", 0.0), ("reentrant", 0.3)]
)
def test_it_does_not_matter_where_the_period_is_cut(kind, friction):
    """Walls that touch across the seam are walls like others."""
    case = pressed(lattice_of(kind, (2, 2), CRUSHES[kind], nodes_per_wall=2), friction=friction)
    one, other = (cut_at(case, cut) for cut in ((0.0, 0.0), (0.37 * L, 0.61 * L)))
    assert is_sound(one)
    assert_alike(one, other, friction)


@pytest.mark.parametrize("kind", CRUSHES)
def test_four_periods_are_as_good_as_one(kind):
    wave = 2 * L * PITCH.get(kind, (1, 1))[1]
    small, large = (
        cut_at(pressed(lattice_of(kind, (n, n), CRUSHES[kind])), wave=wave) for n in (2, 4)
    )
    assert is_sound(small)
    assert is_sound(large)
    assert small.summary["relative_density"] == pytest.approx(large.summary["relative_density"])
    for name in ("work_in_J", "contact_J"):
        expected = density(small, name)
        atol = 1e-6 * expected.max()
        np.testing.assert_allclose(density(large, name), expected, rtol=1e-6, atol=atol)


def test_the_book_is_closed_and_the_work_is_that_of_the_mean_stress():
    result = simulate(pressed(lattice_of("kagome", (2, 2), 0.08), friction=0.3, unload=True))
    assert is_sound(result)
    history = result.history
    assert unbalanced(history) < 1e-8
    assert trapezoid(history) == pytest.approx(history["work_in_J"][-1], rel=1e-3)
    np.testing.assert_array_equal(history["reaction_top_N"], history["reaction_bottom_N"])
    assert result.summary["residual_strain"] == pytest.approx(0.0, abs=1e-6)


CELLS = [("square", (1, 1)), ("square", (2, 1)), ("hex", (1, 2)), ("reentrant", (1, 2))]


@pytest.mark.parametrize(("kind", "cells"), CELLS)
def test_derivatives_in_the_mean_strain_and_the_factor_that_solves_for_it(kind, cells):
    case = pressed(lattice_of(kind, cells, 0.12, imperfection=0.3, nodes_per_wall=2), 0.45)
    scene = periodic.build_periodic(case)
    x, args = crushed(case, scene)
    assert args.energy(x) > 0.0
    assert_derivatives(scene, x, args)
    assert_solved(scene, x, args)
    assert_solved(scene, scene.x_rest, whole(scene, scene.x_rest))


def test_a_led_step_converges_as_newton_does():
    case = pressed(lattice_of("reentrant", (1, 2), 0.12), 0.45)
    scene = periodic.build_periodic(case)
    x, args = crushed(case, scene)
    found = descend(case, scene, x, args, target=x[-1] - 1e-4 * L)
    assert (found.outcome, found.iterations <= 4) == (outcomes.CONVERGED, True)
