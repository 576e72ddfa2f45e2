"""Curves between their rows."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.simulation.between_rows import CURVE, between_rows


def curve(strain, force, height=0.02):
    """A crush with this force (N), and the work of the trapezoidal rule."""
    work = cumulative_trapezoid(force, height * strain, initial=0.0)
    return dict(zip(CURVE, (strain, strain * height, force, 0.9 * force, work), strict=True))


def test_forces_are_linear_and_the_work_is_their_integral():
    rows = curve(np.array([0.0, 0.1, 0.4]), np.array([0.0, 5.0, 2.0]))
    fine = between_rows(rows)
    assert set(rows["strain"]) <= set(fine["strain"])
    np.testing.assert_allclose(
        fine["reaction_top_N"], np.interp(fine["strain"], rows["strain"], rows["reaction_top_N"])
    )
    again = curve(fine["strain"], fine["reaction_top_N"])  # exact for a linear force
    np.testing.assert_allclose(fine["work_in_J"], again["work_in_J"], rtol=0, atol=1e-15)
    assert fine["work_in_J"][-1] == pytest.approx(rows["work_in_J"][-1], rel=1e-14)


def test_work_of_another_rule_keeps_its_values_at_the_rows():
    """Backward Euler books the force at the end of a step."""
    rows = curve(np.linspace(0.0, 0.5, 6), np.linspace(0.0, 3.0, 6) ** 2)
    rows["work_in_J"] = np.cumsum(0.1 * 0.02 * rows["reaction_top_N"])
    fine = between_rows(rows)
    at = np.searchsorted(fine["strain"], rows["strain"])
    np.testing.assert_allclose(fine["work_in_J"][at], rows["work_in_J"], rtol=1e-14)


def test_rows_that_are_one_strain_in_few_digits_and_single_rows():
    rows = curve(np.array([0.0, 0.2, 0.2]), np.array([0.0, 1.0, 1.0]))
    assert all(np.isfinite(column).all() for column in between_rows(rows).values())
    first = {name: column[:1] for name, column in rows.items()}
    assert between_rows(first) == first
