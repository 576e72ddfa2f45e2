"""Bricks of rubber, their ties, and a tube of plates against one of bricks."""

import sys

import numpy as np
import pytest

from tests.studies.plates import gate
from tests.studies.plates.brick import BULK, Solid
from tests.studies.plates.tied import Platen, Tied
from tests.studies.plates.tube import CLAMPED, HINGED, SolidTube

RNG = np.random.default_rng(3)
MODULUS = 67.0
COARSE = {"across": 3, "up": 7}
EARLY = (0.1, 0.5, 1.0, 1.5, 2.0)


def block(size, pieces):
    """A body of equal bricks, its ends at z = 0 and z = size[2]."""
    lines = [np.linspace(0.0, s, 2 * n + 1) for s, n in zip(size, pieces, strict=True)]
    points = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
    first = 2 * np.indices(pieces).reshape(3, -1).T
    corner = np.indices((3, 3, 3)).reshape(3, -1).T
    at = (first[:, None] + corner).transpose(2, 0, 1)
    nodes = np.ravel_multi_index(tuple(at), [len(line) for line in lines])
    return Solid(points, nodes, MODULUS)


def rolling(body):
    """Ties of a body between planes without friction: planes through 0 hold it."""
    unknown, ratio = np.arange(body.size).reshape(-1, 3), np.ones((body.size // 3, 3))
    ratio[body.points == 0.0] = 0.0
    top = body.points[:, 2] == body.points[:, 2].max()
    unknown[top, 2] = body.size
    return Tied(body, unknown.ravel(), ratio.ravel())


@pytest.mark.parametrize("ends", [CLAMPED, HINGED])
def test_gradient_and_hessian_are_derivatives(ends):
    tied = SolidTube(0.4, across=1, up=2, ends=ends).build()
    q, way = (s * RNG.standard_normal(tied.size) for s in (3e-3, 1.0))
    step = 1e-6
    one, two = q + step * way, q - step * way
    slope = (tied.energy(one) - tied.energy(two)) / (2.0 * step)
    assert tied.gradient(q) @ way == pytest.approx(slope, rel=1e-6)
    change = (tied.gradient(one) - tied.gradient(two)) / (2.0 * step)
    assert tied.hessian(q) @ way == pytest.approx(change, abs=1e-7 * np.abs(change).max())


def test_a_body_that_is_turned_has_no_energy_and_one_turned_inside_out_no_end_of_it():
    body, angle = block((1.0, 2.0, 1.0), (1, 1, 1)), 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                     [0, 0, 1]])  # fmt: skip
    moved = (body.points @ turn.T - body.points).ravel()
    assert abs(body.energy(moved)) < 1e-12
    assert np.abs(body.gradient(moved)).max() < 1e-12 * MODULUS
    assert body.energy((-2.0 * body.points).ravel()) == np.inf


def test_a_block_is_pressed_as_neo_hookean_rubber():
    """P = Y / 3 (1 / l^2 - l), by up to 25 %; volume yields by the pressure over K."""
    body = block((1.0, 1.0, 1.0), (1, 1, 1))
    curve = Platen(rolling(body), 1.0).crush([0.01, 0.1, 0.2, 0.25])
    strain, force, _ = np.array(curve.rows).T
    stretch = 1.0 - strain[1:]
    expected = MODULUS / 3.0 * (stretch**-2 - stretch)
    assert force[1:] == pytest.approx(expected, rel=0.1 / BULK)
    assert force[1] / strain[1] == pytest.approx(MODULUS * 1.01, rel=1e-3)


def test_thin_bricks_do_not_lock():
    """A strip of 40 thicknesses, held across, one brick thick, bends by w = F L^3 / (3 D)."""
    thin, wide, long = 0.025, 0.1, 1.0
    body = block((thin, wide, long), (1, 1, 12))
    ratio = np.ones((body.size // 3, 3))
    ratio[:, 1] = 0.0
    ratio[body.points[:, 2] == 0.0] = 0.0
    unknown = np.arange(body.size).reshape(-1, 3)
    end = body.points[:, 2] == long
    unknown[end, 0] = body.size
    tied = Tied(body, unknown.ravel(), ratio.ravel())
    press = Platen(tied, 1.0)
    matrix = tied.hessian(np.zeros(tied.size)).toarray()
    free = press.free
    stiffness = matrix[-1, -1] - matrix[-1, free] @ np.linalg.solve(
        matrix[np.ix_(free, free)], matrix[free, -1]
    )
    rigidity = MODULUS * thin**3 * wide / 12.0 / 0.75
    assert stiffness == pytest.approx(3.0 * rigidity / long**3, rel=0.01)


def test_ends_hold_the_mid_surface_and_hinged_ones_lean():
    for ends in (CLAMPED, HINGED):
        tube = SolidTube(0.4, across=2, up=3, ends=ends)
        tied, (points, _) = tube.build(), tube.mesh()
        q = 1e-2 * RNG.standard_normal(tied.size)
        u, end = tied.moved(q).reshape(-1, 3), points[:, 2] == 0.0
        wall = end & (points[:, 0] > 0.2 + 1e-9)
        middle = wall & (points[:, 1] == 0.0)
        assert middle.sum() == 4
        assert not u[middle].any()
        assert not u[wall, 0].any()
        outer, inner = (u[wall & np.isclose(points[:, 1], y), 2] for y in (0.2, -0.2))
        assert outer == pytest.approx(-inner, abs=1e-15)
        assert outer.any() == (ends == HINGED)


def test_bricks_fill_the_walls_of_an_eighth():
    tube = SolidTube(0.4, through=2, up=3)
    points, nodes = tube.mesh()
    body = Solid(points, nodes, MODULUS)
    assert tube.copies * body.weight.sum() == pytest.approx((4.4**2 - 3.6**2) * 12.0)
    assert len(np.unique(points.round(9), axis=0)) == len(points)


@pytest.mark.parametrize("ends", [CLAMPED, HINGED])
def test_plates_press_as_a_solid_does_through_buckling(ends):
    """Walls of 1 / 20, both on coarse meshes. `make plates_solid` has the rest."""
    solid = gate.solid(0.2, ends, EARLY, **COARSE)
    plates = gate.plates(0.2, ends, 2.0, 6)
    for at in EARLY[1:]:
        assert plates.at(at) == pytest.approx(solid.at(at), rel=0.03)
    assert plates.kink() == pytest.approx(solid.kink(), rel=0.03)


def test_peak_and_kink_of_a_curve():
    at = np.linspace(0.0, 3.0, 31)
    force = np.minimum(at, 1.0 + 0.5 * (at - 1.0))
    assert gate.Curve(at, force, at).kink() == pytest.approx(1.0)
    assert gate.Curve(at, force, at).peak() is None
    assert gate.Curve(at, np.sin(at), at).peak() == pytest.approx((0.5 * np.pi, 1.0), abs=1e-3)


def test_lines_have_errors_in_percent():
    at = np.linspace(0.0, 2.0, 21)
    one, two = (gate.Curve(at, a * np.sqrt(at), at**2) for a in (1.0, 1.1))
    found = dict(line.rsplit(None, 2)[::2] for line in gate.lines(one, [two]) if "at 2" in line)
    assert found == {"force at 2, N": "+10.0"}


def test_tables_have_all_cases(monkeypatch, capsys):
    at = np.linspace(0.0, 2.0, 21)
    asked = []

    def curve(*of, **mesh):
        asked.append((*of[:2], *mesh))
        return gate.Curve(at, np.sqrt(at), at)

    monkeypatch.setattr(gate, "solid", curve)
    monkeypatch.setattr(gate, "plates", lambda *of: curve(*of[:2]))
    gate.main(sys.stdout)
    found = capsys.readouterr().out
    assert found.count("force at 2, N") == len(gate.CASES) + 2
    assert found.count("l/t = ") == len(gate.CASES) + 2
    assert {(t, e) for t, e, *mesh in asked if not mesh} == {case[:2] for case in gate.CASES}
    assert {mesh[0] for _, _, *mesh in asked if mesh} == {"across", "through"}
