"""Shells of one period of a gyroid: flat ones against exact numbers, then all against bricks."""

import sys

import numpy as np
import pytest

from sweep.design.surfaces.names import SHEETS
from tests.studies.surfaces import __main__ as table
from tests.studies.surfaces import moduli, shells
from tests.studies.surfaces.extrapolated import limit
from tests.studies.surfaces.period import Period, best_period

POISSON = 0.3


def flat(n):
    """A flat net normal to z, of n x n quads a period."""
    first = np.indices((n, n)).reshape(2, -1).T
    corner = first[:, None] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    number = corner % n
    shift = np.dstack([corner // n, np.zeros((n * n, 4, 1), int)])
    points = np.column_stack([first / n, np.full(n * n, 0.4)])
    return Period(
        points, np.tile([0.0, 0, 1], (n * n, 1)), number[..., 0] * n + number[..., 1], shift
    )


def test_a_flat_net_of_shells_is_in_plane_stress():
    found, area = shells.stiffness(flat(3), 0.1, 1.0, POISSON)
    expected = np.zeros((6, 6))
    expected[:2, :2] = 0.1 / (1.0 - POISSON**2) * np.array([[1.0, POISSON], [POISSON, 1.0]])
    expected[5, 5] = 0.5 / (1.0 + POISSON) * 0.1
    np.testing.assert_allclose(found, expected, atol=1e-12)
    assert area == pytest.approx(1.0, rel=1e-12)


def test_the_gyroid_of_shells_is_cubic():
    found, area = shells.stiffness(best_period(8), 0.05)
    np.testing.assert_allclose(found, found.T, atol=1e-12)
    assert moduli.cubic(found)[1] < 1e-4
    assert area == pytest.approx(1.012 * SHEETS["gyroid"].area, rel=1e-3)


@pytest.mark.parametrize(("share", "poisson", "most"), [(0.1, 0.3, 0.012), (0.3, 0.45, 0.015)])
def test_shells_have_the_moduli_of_a_solid_wall(share, poisson, most):
    """The shells have 12 quads per period."""
    of = limit(share, 16, poisson)
    found, _ = shells.stiffness(best_period(12), of.thickness, 1.0, poisson)
    away = moduli.cubic(found)[0].moduli / of.moduli - 1.0
    assert 0.5 * most < np.abs(away).max() < most


def test_the_table_has_all_rows(monkeypatch, capsys):
    monkeypatch.setattr(table, "MESHES", (8,))
    monkeypatch.setattr(table, "POISSON", (0.3,))
    monkeypatch.setattr(table, "GRIDS", {0.3: 8})
    table.main(sys.stdout)
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split()[:6] == ["n", "=", "8", "288", "+1.20%", "0.66"]
    assert lines[2].split()[7:] == [*moduli.NAMES, "share"]
    assert [line.split()[0] for line in lines[3:9]] == [
        "8^3",
        "16^3",
        "32^3",
        "limit",
        "order",
        "error",
    ]
    assert lines[9].split()[:4] == ["shells,", "n", "=", "8"]
    assert lines[10].endswith("30.398%")
