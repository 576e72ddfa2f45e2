"""Shells against the theory of plates, at four to sixteen quads across."""

import numpy as np
import pytest

from tests.studies.plates import __main__ as table
from tests.studies.plates import buckled, joints, square, strip
from tests.studies.plates.square import CLAMPED, SUPPORTED


def slope(found, exact, meshes):
    """Order at which numbers approach the exact one between the last two meshes."""
    errors = np.abs(np.array(found) / exact - 1.0)
    return np.log(errors[-2] / errors[-1]) / np.log(meshes[-1] / meshes[-2])


@pytest.mark.parametrize(
    ("sides", "ends", "exact", "coarse", "fine"),
    [(*square.BUCKLING[0], 2e-3, 1e-3), (*square.BUCKLING[1], 0.035, 0.01),
     (*square.BUCKLING[2], 0.065, 0.015)],
)  # fmt: skip
def test_plates_buckle(sides, ends, exact, coarse, fine):
    found = [square.factor(n, sides, ends) for n in (4, 8, 16)]
    assert found[0] == pytest.approx(exact, rel=coarse)
    assert found[1] == pytest.approx(exact, rel=fine)
    assert slope(found, exact, (8, 16)) == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize(("edges", "exact", "limit"), [(*square.PRESSURE[0], 4e-3),
                                                      (*square.PRESSURE[1], 0.02)])  # fmt: skip
@pytest.mark.parametrize("thickness", [1e-3, 1e-5])
def test_plates_deflect_under_pressure(edges, exact, limit, thickness):
    found = [square.pressed(n, edges, thickness) for n in (8, 16)]
    assert found[0] == pytest.approx(exact, rel=limit)
    assert found[1] == pytest.approx(exact, rel=limit / 3)


@pytest.mark.parametrize("thickness", [0.1, 0.2])
def test_shear_makes_thick_plates_softer(thickness):
    found = [square.knock_down(n, thickness) for n in (4, 8, 16)]
    assert found[1] == pytest.approx(square.mindlin(thickness), rel=4e-3)
    assert slope(found, square.mindlin(thickness), (8, 16)) == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize(("thickness", "stiffer"), [(0.01, 1.0005), (0.1, 1.028), (0.2, 1.10)])
def test_compressed_plates_buckle_near_the_strain_of_mindlins_plate(thickness, stiffer):
    """Finite strain makes thick ones stiffer, mostly in shear."""
    kirchhoff = 4.0 * np.pi**2 / 9.0 * thickness**2
    ratio = square.critical_strain(6, thickness) / kirchhoff / square.mindlin(thickness)
    assert ratio == pytest.approx(stiffer, rel=2e-3)


def test_a_strip_is_rolled_to_a_circle():
    """The moment is 2 pi D b / L; elements turn by 45 degrees each, or by less."""
    (coarse, _), (fine, gap) = strip.rolled(8), strip.rolled(16)
    assert coarse == pytest.approx(1.0, abs=0.03)
    assert fine == pytest.approx(1.0, abs=3e-3)
    assert gap < 1e-6


@pytest.mark.parametrize("degrees", [20, 40, 60, 80])
def test_a_column_bends_as_the_elastica(degrees):
    tip = np.radians(degrees)
    assert strip.pushed(8, tip) == pytest.approx(strip.column(tip)[1], rel=5e-3)


def test_the_elastica():
    """Timoshenko and Gere, table 2-1."""
    found = [strip.column(np.radians(a)) for a in (20, 40, 60, 80)]
    expected = [(1.015, 0.970), (1.063, 0.881), (1.152, 0.741), (1.293, 0.560)]
    np.testing.assert_allclose(found, expected, atol=1.1e-3)


@pytest.mark.parametrize("thickness", [0.05, 0.1, 0.2])
def test_thick_strips_lose_their_stiffness_where_the_solid_does(thickness):
    strain = 1.0 - strip.critical_stretch(8, thickness)
    assert strain == pytest.approx(1.0 - strip.exact_stretch(thickness), rel=0.01)


def test_the_exact_strip_is_a_column_if_it_is_thin_and_a_half_space_if_it_is_thick():
    strain = 1.0 - strip.exact_stretch(0.01)
    assert strain == pytest.approx(np.pi**2 / 12 * 1e-4, rel=1e-4)
    assert 1.0 - strip.exact_stretch(3.0) == pytest.approx(0.4563, abs=2e-3)


@pytest.mark.parametrize("kind", [joints.TUBE, joints.X_JOINT, joints.Y_JOINT])
@pytest.mark.parametrize("n", [4, 8])
def test_joints_do_not_hinder_walls_that_buckle_like_a_chequerboard(kind, n):
    """A tube of t / l = 0.025 has a knock-down by shear of 0.995."""
    assert joints.factor(kind, n) == pytest.approx(4.0, rel=6e-3)


def test_sides_that_are_clamped_cannot_buckle_like_a_chequerboard():
    assert square.factor(4, CLAMPED, SUPPORTED) > 1.7 * square.factor(4, SUPPORTED, SUPPORTED)


def test_a_long_plate_buckles_in_squares():
    assert buckled.wave(8) == pytest.approx(1.0, abs=1e-3)


def test_sides_that_wave_leave_less_stiffness():
    """0.408: G. Hemp, 1945."""
    assert buckled.waving() == pytest.approx(0.408, abs=5e-4)


@pytest.mark.parametrize(
    ("sides", "coarse", "fine"), [(buckled.STRAIGHT, 0.02, 8e-3), (buckled.WAVING, 0.03, 8e-3)]
)
def test_stiffness_that_is_left_after_buckling(sides, coarse, fine):
    """The theory is of one wave each way: sides that wave soon need more."""
    found = [buckled.left(n, sides) / buckled.LEFT[sides] for n in (8, 12)]
    assert found[0] == pytest.approx(1.0, abs=coarse)
    assert found[1] == pytest.approx(1.0, abs=fine)


def test_the_table_has_all_rungs(monkeypatch, capsys):
    monkeypatch.setattr(table, "MESHES", (4,))
    monkeypatch.setattr(table, "rows", lambda: [*table_rows()][:2])
    table.main()
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["exact", "4", "quads"]
    assert [line.split()[-1] for line in lines[1:]] == ["+0.08%", "+3.11%"]


table_rows = table.rows
