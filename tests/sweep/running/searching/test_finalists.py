"""Which designs are finalists, and how they are simulated again."""

import pytest

from sweep.config.case import Case
from sweep.design.lattice import counted_area
from sweep.ranking.spread import FINE
from sweep.result import design_columns
from sweep.running.searching.finalists import finalists, perturbed
from tests.support.designs.tables import lattice_with

PRESSED = dict(mode="displacement", strain=0.3)


def design(kind, cells, walls):
    axes = {"lattice.kind": kind, "lattice.cells_x": cells, "lattice.wall_thickness": walls}
    lattice = dict(kind=kind, cells_x=cells, wall_thickness=walls)
    return Case.of(lattice=lattice, loading=PRESSED, axes=axes)


def test_finalists_stand_on_different_peaks():
    first, near = design("hex", 3, 0.60e-3), design("hex", 3, 0.62e-3)
    others = [design("hex", 3, 0.66e-3), design("hex", 4, 0.60e-3), design("square", 3, 0.6e-3)]
    assert finalists([first, near, *others]) == [first, *others[:2]]
    assert finalists([first, near]) == [first]


def test_each_has_twice_the_elements_and_one_change():
    case = design("hex", 3, 0.6e-3)
    found = {name: corner.lattice for name, corner in perturbed(case).items()}
    assert {lattice.nodes_per_wall for lattice in found.values()} == {15}
    walls = [lattice.wall_thickness for lattice in found.values()]
    assert walls == pytest.approx([0.6e-3, 0.57e-3, 0.63e-3, 0.6e-3, 0.6e-3])
    bows = [lattice.imperfection for lattice in found.values()]
    assert bows == pytest.approx([0.01, 0.01, 0.01, 0.0025, 0.04])
    assert next(iter(found)) == FINE
    assert len({corner.case_id for corner in perturbed(case).values()} | {case.case_id}) == 6


def test_walls_of_a_given_mass_stay_as_they_were():
    case = Case.of(lattice=dict(mass=1e-3), loading=PRESSED, axes={"lattice.mass": 1e-3})
    walls = [corner.lattice.wall_thickness for corner in perturbed(case).values()][:3]
    same = case.lattice.wall_thickness
    assert walls == pytest.approx([same, 0.95 * same, 1.05 * same])


def test_straight_walls_have_no_imperfection_to_change():
    case = Case.of(lattice=dict(imperfection=0.0), loading=PRESSED)
    assert list(perturbed(case)) == [FINE, "walls -5 %", "walls +5 %"]


def test_layers_that_are_given_are_twice_as_many_but_no_lower_than_walls():
    """12 mm hold 30 quads as high as walls of 0.4 mm."""
    given = {"width": 12e-3, "height": 12e-3, "depth": 12e-3, "cells_x": 1, "cells_y": 1}
    lattice = dict(wall_thickness=0.4e-3, nodes_per_wall=3, layers=12, **given)
    case = Case.of(lattice=lattice, loading=dict(direction="out_of_plane", strain=0.3))
    assert perturbed(case)[FINE].lattice.layers == 24
    high = case.model_copy(update={"lattice": case.lattice.model_copy(update={"layers": 28})})
    assert [corner.lattice.layers for corner in perturbed(high).values()] == [30, 31, 28, 30, 30]


def test_plates_of_many_nodes_keep_their_mesh():
    given = {"width": 20e-3, "height": 20e-3, "cells_x": 5, "cells_y": 5, "wall_thickness": 0.3e-3}
    case = Case.of(lattice=given, loading=dict(direction="out_of_plane", strain=0.3))
    found = {name: corner.lattice for name, corner in perturbed(case).items()}
    assert list(found) == ["walls -5 %", "walls +5 %", "imperfection / 4", "imperfection x 4"]
    meshes = {(lattice.nodes_per_wall, lattice.layers) for lattice in found.values()}
    assert meshes == {(case.lattice.nodes_per_wall, case.lattice.layers)}


@pytest.mark.parametrize("slicer", ["prusa", "cura"])
def test_lines_of_a_slicer_are_wider_at_the_same_distance(slicer):
    """The wider lines extrude 5 % more. The settings are a column of the results."""
    laid = lattice_with(slicer=slicer, pattern="grid", infill=0.2, width=25e-3, height=25e-3)
    cases = perturbed(Case.of(lattice=laid, loading=PRESSED))
    thin, fine, thick = (cases[name].lattice for name in ("walls -5 %", FINE, "walls +5 %"))
    assert fine.infill == 0.2
    walls = [lattice.wall_thickness / laid.wall_thickness for lattice in (thin, fine, thick)]
    assert walls == pytest.approx([0.95, 1.0, 1.05])
    assert thin.fill_distance == pytest.approx(thick.fill_distance)
    extruded = counted_area(thick.geometry) / counted_area(laid.geometry)
    assert extruded == pytest.approx(1.05, rel=0.01)
    assert all(design_columns(case)["slicer_settings"] for case in cases.values())
    assert len({case.case_id for case in cases.values()}) == 5
