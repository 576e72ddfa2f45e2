"""The designs of a unit cube: walls and masses within a budget and between openings."""

from math import inf

import numpy as np
import pytest

from sweep.config.load import load_config
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.running.searching.design_space import USED_UP, DesignSpace
from sweep.simulation.summary import printed_mass

WALLS = '"lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"}'
MASS = '"lattice.mass" = {from = "0.5 g", to = "5 g"}'
CELLS = "lattice.cells_x = {from = 2, to = 6}"
POINTS = np.random.default_rng(1).random((40, 2))


@pytest.fixture
def space(tmp_path):
    """The space of some lines below [search], and of lines before it."""

    def made(*lines, head="", **limits):
        path = tmp_path / "sought.toml"
        path.write_text("\n".join(['[lattice]\nwidth = "25 mm"', head, "[search]", *lines]))
        return DesignSpace(load_config(path), **limits)

    return made


def grams(case):
    lattice = case.lattice
    return 1e3 * mass(build_network(lattice.geometry), lattice.depth, case.material.density)


def panel_grams(case, panel):
    """Specimens side by side are 0.4 mm apart."""
    lattice = case.lattice
    across = round((panel[0] + 4e-4) / (lattice.outer_size[0] + 4e-4))
    return grams(case) * across * round(panel[1] / lattice.depth)


@pytest.mark.parametrize("size", [WALLS, MASS])
def test_all_designs_are_within_the_budget_and_some_use_it_up(space, size):
    of = space(CELLS, size, budget=1.5e-3)
    found = [of.case(point) for point in POINTS]
    masses = [grams(case) for case in found]
    assert max(masses) <= 1.5 * (1.0 + 1e-9)
    assert max(masses) > 1.499
    assert len({case.lattice.cells_x for case in found}) == 5
    assert min(case.lattice.wall_thickness for case in found) < 0.5e-3
    if size == WALLS:
        assert of.case((0.5, 1.0)) == of.case((0.5, 1.001 / USED_UP))
        assert of.case((0.5, 1.0)) != of.case((0.5, 0.99 / USED_UP))


@pytest.mark.parametrize("pattern", ["grid", "honeycomb"])
@pytest.mark.parametrize(
    "line",
    [
        '"lattice.infill" = {from = "8 %", to = "60 %"}',
        '"lattice.mass" = {from = "2 g", to = "8 g"}',
    ],
)
def test_budget_counts_what_a_slicer_extrudes(space, pattern, line):
    head = f'height = "25 mm"\nslicer = "prusa"\npattern = "{pattern}"'
    found = [space(line, head=head, budget=3e-3).case([share]) for share in (0.0, 0.5, 1.0)]
    masses = [printed_mass(case) for case in found]
    assert masses == sorted(masses)
    assert 2.9 < masses[-1] <= 3.0 * (1.0 + 1e-9)
    assert grams(found[-1]) < 0.99 * masses[-1]
    panel = space(line, head=head, budget=40e-3, panel=(0.1, 0.05))
    case = panel.case([1.0])
    assert panel.weight(case) == pytest.approx(1e-3 * 4 * 4 * printed_mass(case))
    assert 39.0 < 1e3 * panel.weight(case) <= 40.0 * (1.0 + 1e-9)
    if "infill" in line:  # the least one weighs more
        assert space(line, head=head, budget=0.5e-3).case([0.0]) is None


def test_panel_of_what_is_pressed_along_its_cells_is_filled_by_plans(space):
    """A plan of 25 x 12.5 mm over centre lines: 4 x 4 of them fill 100 x 50 mm."""
    of = space(
        '"lattice.wall_thickness" = {from = "0.4 mm", to = "0.5 mm"}',
        head='[loading]\ndirection = "out_of_plane"',
        panel=(0.1, 0.05),
        budget=1.0,
    )
    case = of.case((0.0,))
    assert case.loading.direction == "out_of_plane"
    assert of.weight(case) == pytest.approx(16e-3 * grams(case))


@pytest.mark.parametrize("size", [WALLS, MASS])
def test_budget_of_a_panel_counts_its_specimens(space, size):
    panel = (0.1, 0.05)
    case = space(CELLS, size, budget=20e-3, panel=panel).case((0.5, 1.0))
    assert panel_grams(case, panel) == pytest.approx(20.0, rel=2e-3)
    assert panel_grams(case, panel) <= 20.0


@pytest.mark.parametrize("width", np.linspace(0.08, 0.11, 13))
def test_one_specimen_more_does_not_exceed_the_budget(space, width):
    """Thinner walls make narrower specimens, of which a panel may have one more."""
    panel = (float(width), 0.05)
    case = space(CELLS, WALLS, budget=20e-3, panel=panel).case((0.5, 1.0))
    assert 0.7 * 20.0 < panel_grams(case, panel) <= 20.0


def test_without_a_budget_the_ends_are_those_of_the_config(space):
    of = space(CELLS, WALLS)
    ends = [of.case((0.0, share)).lattice.wall_thickness for share in (0.0, 1.0)]
    assert ends == [0.4e-3, 1.6e-3]


def test_walls_leave_openings_between_many_cells(space):
    of = space("lattice.cells_y = {from = 2, to = 12}", WALLS)
    thick = of.case((1.0, 1.0)).lattice
    assert 0.99 * thick.thickest < thick.wall_thickness < thick.thickest < 0.6e-3
    assert space("lattice.cells_y = [2, 40]", WALLS).case((1.0, 0.0)) is None


def test_designs_whose_least_walls_exceed_the_budget_do_not_exist(space):
    of = space(CELLS, WALLS, budget=0.9e-3)
    assert of.case((0.0, 0.0)) is not None
    assert of.case((1.0, 0.0)) is None


def test_designs_of_one_thickness_are_weighed(space):
    of = space(CELLS, budget=1.7e-3)
    weights = {cells: of.case([(cells - 1.5) / 5]) for cells in range(2, 7)}
    known = space(CELLS, budget=inf)
    for cells, case in weights.items():
        assert (case is None) == (grams(known.case([(cells - 1.5) / 5])) > 1.7)
    assert None in weights.values()
    assert any(weights.values())


def test_panel_that_holds_no_specimen_has_no_designs(space):
    assert space(CELLS, WALLS, panel=(0.1, 0.005)).case((0.5, 0.5)) is None
    assert space(CELLS, WALLS, budget=20e-3, panel=(0.012, 0.05)).case((0.5, 0.5)) is None
