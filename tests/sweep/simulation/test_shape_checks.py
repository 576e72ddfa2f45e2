"""Measures of stored shapes, on shapes made by hand."""

from itertools import combinations

import numpy as np
import pytest
import shapely

from kernels.terms.elements import Walls
from kernels.terms.stretch import Stretch
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from sweep.simulation.shape_checks import (
    crossings,
    deformations,
    element_strains,
    kept_area,
    shortening,
    surface_strains,
    work_within_model,
)
from tests.support.kernels.solving import whole
from tests.support.kernels.states import loaded
from tests.support.results.specimens import squeezed_cell

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]
BOTTOM, TOP = np.array([0, 1]), np.array([2, 3])


def frames(*shapes, edges=SIDES, thickness=0.1):
    """Frames of these shapes at times 0, 1, 2, ..., with strains that rise."""
    return {
        "strain": np.linspace(0.0, 0.5, len(shapes)),
        "time_s": np.arange(float(len(shapes))),
        "position_m": np.array(shapes, float),
        "edges": np.array(edges),
        "edge_thickness_m": np.full(len(edges), thickness),
    }


def scaled(x, y):
    return np.array(SQUARE) * [x, y]


def strains_of(shapes, rotation=0.0, arc=(0.0, 0.0)):
    """Strains of elements whose ends have all turned by ``rotation``, from the first shape on."""
    edges, position = shapes["edges"], shapes["position_m"]
    n = len(position[0])
    turns = np.full((len(position), n), rotation)
    x = np.hstack([position.reshape(len(position), -1), turns])
    dofs = np.stack([2 * edges, 2 * edges + 1, 2 * n + edges], axis=-1).reshape(-1, 6)
    along = position[0][edges[:, 1]] - position[0][edges[:, 0]]
    length = np.linalg.norm(along, axis=1)
    walls = Walls(edges, np.array([0, len(edges)]), along / length[:, None], dofs)
    stretch = Stretch(length, length, np.tile(np.array(arc)[:, None], len(edges)), True)
    return element_strains(deformations(x, walls), stretch)


def test_strains_of_elements():
    strains = strains_of(frames(SQUARE, scaled(1.25, 0.6)))
    assert strains == pytest.approx(np.array([[0.0] * 4, [0.25, -0.4, 0.25, -0.4]]))


@pytest.mark.parametrize("turn", [0.3, -0.3, 2 * np.pi + 0.3])
def test_strains_are_those_of_arcs(turn):
    """Both ends turned against the chord by 0.3: 0.3^2 (2 c_s + c_m) longer, however often."""
    strains = strains_of(frames(SQUARE), turn, (1 / 15, -1 / 30))
    assert strains == pytest.approx(np.full((1, 4), 0.009))


@pytest.mark.parametrize("turn", [-3.3, 0.4, 7.0])
def test_deformations_are_those_of_the_kernels(turn):
    """Even where a node turns by more than half between two stored shapes."""
    scene = loaded()
    walls, x = scene.terms.walls, scene.x_rest.copy()
    x[walls.dofs[len(walls.dofs) // 2, 2]] += turn
    made = whole(scene, x)
    made.found(x)
    length, one, two = deformations(np.array([scene.x_rest, x]), walls)
    shape = made.problem.buffers.shape
    np.testing.assert_allclose(length[1], shape.length, rtol=1e-14)
    np.testing.assert_allclose([one[1], two[1]], shape.turn, atol=1e-12)


def test_surfaces_of_straight_walls_are_stretched_like_their_middle():
    """The surface of a bent wall is stretched more."""
    scene = build_scene(Case.of(material={"bend": "section"}))
    walls, bend = scene.terms.walls, scene.terms.bend
    assert (bend.volume > 0.0).any()
    longer = 1.02 * scene.x_rest
    turned = longer.copy()
    turned[walls.dofs[len(walls.dofs) // 2, 2]] += 0.1
    deformation = deformations(np.array([longer, turned]), walls)
    strains = element_strains(deformation, scene.terms.stretch)
    straight, bent = surface_strains(deformation, strains, bend)
    np.testing.assert_allclose(straight, 0.02)
    assert (bent >= strains[1] - 1e-12).all()
    assert bent.max() > strains[1].max() + 0.001


def within_model(shapes, time, work, broken=np.nan):
    return work_within_model(strains_of(shapes), broken, shapes["time_s"], time, work)


def test_work_within_the_model_ends_where_an_element_is_squeezed_too_far():
    """0.7 of the length is passed half-way between the shapes at 1 s and 2 s."""
    shapes = frames(SQUARE, scaled(1.0, 0.8), scaled(1.0, 0.6), scaled(1.0, 0.9))
    time = np.linspace(0.0, 3.0, 31)
    assert within_model(shapes, time, time**2) == pytest.approx(2.25)
    assert within_model(shapes, time, time**2, 1.2) == pytest.approx(1.44)
    assert within_model(shapes, time, time**2, 1.8) == pytest.approx(2.25)


def test_all_work_is_within_the_model_where_none_is():
    time = np.array([0.0, 1.0, 2.0])
    shapes = frames(SQUARE, scaled(1.9, 0.71), scaled(1.0, 0.8))
    assert within_model(shapes, time, time) == 2.0
    let_up = frames(SQUARE, scaled(1.0, 0.9), scaled(1.0, 0.9), scaled(1.0, 0.5))
    assert within_model(let_up, time, time) == 2.0
    assert within_model(frames(SQUARE), time[:1], time[:1]) == 0.0


def test_kept_area_of_walls_that_overlap():
    """Two walls, 10 x 0.1, brought to half a thickness of one another."""
    walls = [[0, 1], [2, 3]]
    apart = [[0, 0], [10, 0], [0, 1], [10, 1]]
    near = [[0, 0], [10, 0], [0, 0.05], [10, 0.05]]
    assert kept_area(frames(apart, near, edges=walls)) == pytest.approx(0.75, abs=2e-3)
    assert kept_area(frames(apart, apart, edges=walls)) == 1.0


def test_kept_area_is_that_of_the_deepest_shape():
    cell = squeezed_cell()
    area = [(11.0 * (h + 1.0) - 9.0 * (h - 1.0)) for h in (10.0, 5.0)]
    assert kept_area(cell) == pytest.approx(area[1] / area[0], rel=4e-3)


def test_shortening_is_that_of_the_last_shape():
    squashed = frames(SQUARE, scaled(1.0, 0.5), scaled(1.0, 0.8))
    assert shortening(squashed, BOTTOM, TOP) == pytest.approx(0.2)


def test_a_specimen_that_has_turned_over_is_as_long_as_before():
    turn = np.pi / 4 * np.arange(1, 4)
    turned = [
        SQUARE @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) + 3.0 for a in turn
    ]
    assert shortening(frames(SQUARE, *turned), BOTTOM, TOP) == pytest.approx(0.0, abs=1e-12)


def crossings_by_shapely(shapes, edges):
    """Every pair of elements without a common node, in every shape."""
    lines = [shapely.linestrings(np.asarray(points)[edges]) for points in shapes]
    apart = [(i, j) for i, j in combinations(range(len(edges)), 2) if not {*edges[i]} & {*edges[j]}]
    return max(sum(one[i].intersects(one[j]) for i, j in apart) for one in lines)


def test_crossings_are_those_of_every_pair_of_every_shape():
    random = np.random.default_rng(7)
    tangle, edges = random.random((6, 21, 2)), np.column_stack([np.arange(20), np.arange(1, 21)])
    expected = crossings_by_shapely(tangle, edges)
    assert crossings(frames(*tangle, edges=edges)) == expected > 20


@pytest.mark.parametrize("grid", [2, 3, 4])
def test_crossings_where_ends_lie_on_other_elements(grid):
    """On a coarse grid most elements touch, overlap or are no more than points."""
    random = np.random.default_rng(grid)
    shapes = random.integers(0, grid, (8, 30, 2)).astype(float)
    edges = np.arange(30).reshape(15, 2)
    expected = crossings_by_shapely(shapes, edges)
    assert crossings(frames(*shapes, edges=edges)) == expected > 20


def test_crossings_where_rounding_would_tell():
    """Three points of a line that floats cannot hold: nearly all ends are next to one."""
    random = np.random.default_rng(5)
    along = random.random((50, 12))
    shapes = np.stack([along, along / 3.0 + 0.1], axis=2)
    edges = np.arange(12).reshape(6, 2)
    for shape in shapes:
        assert crossings(frames(shape, edges=edges)) == crossings_by_shapely([shape], edges)
