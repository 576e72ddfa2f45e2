"""The scene of a crush along the cells: unknowns, masses, a striker, a shape without stress."""

import numpy as np
import pytest

from kernels.plates.element import shell
from kernels.solve.problem import HELD, LED, TIED
from sweep.config.case import Case
from sweep.scene.plates.scene import build_scene
from tests.support.designs.plates import along


def struck(platen="glued", **lattice):
    loading = dict(direction="out_of_plane", mode="impact", platen=platen, striker_mass=0.02)
    return build_scene(Case.of(lattice=along(**lattice).lattice, loading=loading))


@pytest.fixture(scope="module")
def pressed():
    return build_scene(along(cells_x=2, cells_y=2, imperfection=0.3))


def test_led_ends_have_no_unknown_and_follow(pressed):
    layout, mesh = pressed.terms.layout, pressed.mesh
    assert layout.driven == layout.leader.size - 1
    led = np.flatnonzero(pressed.terms.coordinates.role == LED)
    assert np.array_equal(np.sort(led), np.append(np.sort(6 * mesh.top + 2), layout.driven))
    assert np.all(layout.unknown[led] == -1)
    assert np.array_equal(np.flatnonzero(layout.follows), np.sort(mesh.top))


def test_a_striker_is_the_last_unknown():
    scene = struck(cells_x=1, cells_y=1)
    layout, coordinates = scene.terms.layout, scene.terms.coordinates
    high = layout.leader.size - 1
    assert layout.driven == -1
    assert layout.size[-1] == 1
    assert layout.unknown[high] == layout.size.sum() - 1
    tied = 6 * scene.mesh.top + 2
    assert np.all(coordinates.role[tied] == TIED)
    assert np.all(layout.unknown[tied] == layout.unknown[high])
    assert np.all(coordinates.heavy[tied] == 1.0)
    assert coordinates.mass[high] == 0.02
    assert set(scene.velocity[np.append(tied, high)]) == {-2.0}
    assert np.count_nonzero(scene.velocity) == len(tied) + 1


def test_a_quarter_has_a_quarter_of_the_masses():
    whole, quarter = (struck(cells_x=1, cells_y=1, symmetry=s) for s in ("none", "quarter"))
    four = [scene.terms.coordinates.mass for scene in (whole, quarter)]
    assert four[0].sum() == pytest.approx(4.0 * four[1].sum(), rel=1e-12)


def test_held_coordinates_have_no_unknown(pressed):
    coordinates, layout = pressed.terms.coordinates, pressed.terms.layout
    held = coordinates.role == HELD
    assert np.array_equal(held, layout.leader < 0)
    assert np.all(layout.unknown[held] == -1)
    assert np.all(coordinates.heavy[held] == 0.0)


def test_bowed_walls_are_free_of_stress_at_rest(pressed):
    terms, g = pressed.terms, np.zeros_like(pressed.x_rest)
    parts, of = np.zeros(3), terms.make_buffers(pressed.at_rest().memory)
    shell.evaluate(
        pressed.x_rest, of.committed, terms.shell, terms.law, of.memory, of.shell, g, parts
    )
    assert np.abs(parts).max() < 1e-20
    assert np.abs(g).max() < 1e-9


def test_reactions_below_are_those_of_the_held_ends_or_of_a_loose_platen(pressed):
    mesh = pressed.mesh
    low = pressed.x_rest.size - 2
    assert np.array_equal(pressed.bottom, np.append(6 * mesh.bottom + 2, low))
    loose = build_scene(along("contact", cells_x=1, cells_y=1))
    assert loose.bottom.tolist() == [6 * loose.mesh.n_nodes]


def test_sizes_of_the_tolerance_are_forces(pressed):
    """A wall of 6 mm and 0.3 mm: Y t^3 / (12 l)."""
    case = along(cells_x=2, cells_y=2)
    expected = case.material.modulus * 0.3e-3**3 / (12.0 * 6e-3)
    assert pressed.force_scale == pytest.approx(expected)
    assert pressed.size == pytest.approx(12e-3 + 2.0 * 0.3 * 0.3e-3)  # bowed on both sides
