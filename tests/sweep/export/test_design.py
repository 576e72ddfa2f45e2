"""The design of a stored case is that which ran, or none."""

import json

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.grid import Config, Written
from sweep.config.load import load_config
from sweep.config.reading.examples import examples
from sweep.design.lattice import build_network
from sweep.export.design import design_of, stored_design
from sweep.export.errors import ExportError
from sweep.running.provenance import config_text
from tests.support.designs.infills import EDGES, KINDS, lattice_of
from tests.support.results.exported import config_of, grid, row_of


@pytest.mark.parametrize(("kind", "way"), KINDS)
@pytest.mark.parametrize("edge", EDGES)
def test_every_family_is_rebuilt(kind, way, edge):
    case = Case.of(lattice=lattice_of(kind, way, grading=1.5, **EDGES[edge]))
    found = stored_design(row_of(case), config_of(case))
    assert found.lattice == case.lattice
    assert found.volume == pytest.approx(1e-3 * found.grams / case.material.density, rel=1e-12)


@pytest.mark.parametrize("wish", [{"mass": 1.2e-3}, {"infill": 0.2, "width": 50e-3}])
def test_what_follows_from_a_wish_is_kept(wish):
    case = Case.of(lattice=wish)
    found = stored_design(row_of(case), config_of(case))
    drawn = build_network(case.lattice.geometry)
    np.testing.assert_array_equal(found.network.points, drawn.points)
    np.testing.assert_array_equal(found.network.wall_thickness, drawn.wall_thickness)


def test_axes_and_given_values_go_before_the_first_case():
    first, case = grid(), Case.of(lattice=lattice_of("hex", "flat", cells=(2, 3), perimeters=1))
    config = config_of(first) | {"base": {"lattice.orientation": "flat", "solver.element": "cubic"}}
    row = row_of(case) | {"lattice.perimeters": np.int64(1), "lattice.cells": np.int64(2)}
    assert stored_design(row, config).lattice.orientation == "flat"
    with pytest.raises(ExportError, match="does not follow from the config"):
        stored_design(row, config_of(first))


def test_given_values_are_in_the_config_of_a_file():
    given = {"lattice.orientation": Written("flat", '"flat"'), "solver.load_steps": Written(9, "9")}
    config = json.loads(config_text(Config("trial", base=given), grid()))
    case = Case.of(lattice=lattice_of("hex", "flat", cells=(2, 3)))
    assert stored_design(row_of(case), config).lattice == case.lattice


def test_blank_axes_are_not_given():
    case = grid()
    row = row_of(case) | {"lattice.orientation": "", "lattice.file": ""}
    assert stored_design(row, config_of(case)).lattice == case.lattice


@pytest.mark.parametrize("config", [{}, {"rank": {}}])
def test_file_without_a_config_has_no_design(config):
    with pytest.raises(ExportError, match="run the config of this case once more"):
        stored_design(row_of(grid()), config)


def test_row_that_no_lattice_fits_is_refused():
    with pytest.raises(ExportError, match="does not follow"):
        stored_design(row_of(grid(), wall_thickness_m=0.1), config_of(grid()))


def test_row_of_another_thickness_is_refused():
    case = grid()
    row = row_of(case, wall_thickness_m=0.801e-3)
    with pytest.raises(ExportError, match=case.case_id):
        stored_design(row, config_of(case))


def test_custom_structure_is_drawn_as_in_its_file():
    assert "custom" in examples()
    case = load_config("custom").cases[0]
    design = design_of(case)
    again = config_of(case)
    row = {
        "relative_density": 0.0,
        "case_id": "a",
        "lattice_kind": "custom",
        "mass_g": design.grams,
    }
    row |= {f"{name}_m": getattr(case.lattice, name) for name in ("width", "height", "depth")}
    row |= {"wall_thickness_m": case.lattice.wall_thickness, "cells_x": 1, "cells_y": 1}
    width, height = case.lattice.outer_size
    row["relative_density"] = design.network.printed_area / (width * height)
    assert stored_design(row, again).lattice.structure == case.lattice.structure


def test_period_of_an_endless_lattice_is_no_part():
    with pytest.raises(ExportError, match=r"lattice\.boundary.*no part; allowed: \.csv"):
        design_of(Case.of(lattice=dict(boundary="periodic"), loading={"mode": "displacement"}))


@pytest.mark.parametrize("perimeters", [0, 1])
def test_design_that_is_pressed_along_its_cells_is_rebuilt(perimeters):
    lattice = dict(height=9e-3, depth=14e-3, perimeters=perimeters, cells_x=2, cells_y=2)
    case = Case.of(lattice=lattice, loading=dict(direction="out_of_plane"))
    row = row_of(case)
    assert row["height_m"] == 14e-3
    found = stored_design(row, config_of(case))
    assert found.along
    assert found.depth == 14e-3
    assert found.lattice.height == pytest.approx(9e-3, rel=1e-12)
    assert found.volume == pytest.approx(1e-3 * found.grams / case.material.density, rel=1e-9)


SLICED = {"slicer": "orca", "width": 25e-3, "height": 25e-3}


@pytest.mark.parametrize(
    "wish",
    [
        {"pattern": "grid", "mass": 3e-3},
        {"pattern": "honeycomb", "infill": 0.3, "fill_angle": 0.2},
        {"pattern": "tri-hexagon", "infill": 0.2, "fill_multiline": 2, "perimeters": 3},
    ],
)
def test_infill_of_a_slicer_is_rebuilt(wish):
    """Also where the first case of the sweep has another pattern and share."""
    case = Case.of(lattice=dict(**SLICED, **wish))
    other = Case.of(lattice=SLICED | wish | {"pattern": "triangles", "infill": 0.1, "mass": None})
    row = row_of(case) | {"lattice.pattern": wish["pattern"]}
    for first in (case, other):
        found = stored_design(row, config_of(first))
        assert found.lattice.geometry == case.lattice.geometry
        if "mass" in wish:
            assert found.extruded_grams == pytest.approx(3.0, rel=5e-3)
        assert found.extruded_grams > found.grams


def test_family_beside_a_slicer_has_no_pattern():
    first, case = Case.of(lattice=dict(**SLICED, pattern="grid", infill=0.2, perimeters=1)), grid()
    row = row_of(case) | {"lattice.perimeters": 0}
    assert stored_design(row, config_of(first)).lattice.slicer is None
