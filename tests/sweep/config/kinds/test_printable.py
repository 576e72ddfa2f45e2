"""Designs that do not print: described in words, refused in a single case, left out of a grid."""

import pytest

from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from sweep.config.kinds.printable import what_does_not_print
from tests.support.designs.structures import ROD, structure
from tests.support.designs.tables import lattice_with

MANY = {"cells_x": 12, "cells_y": 12, "wall_thickness": 0.5e-3}
KEPT = (
    '[lattice]\nprintable = true\n[grid]\n"lattice.wall_thickness" = ["0.4 mm", "0.6 mm", "0.8 mm"]'
)


@pytest.mark.parametrize(
    ("lattice", "wrong"),
    [
        ({}, ""),
        ({"wall_thickness": 0.79e-3}, ""),
        ({"wall_thickness": 0.6e-3}, "walls of 1.5 lines of 0.4 mm"),
        ({"wall_thickness": 0.6e-3, "nozzle": 0.6e-3}, ""),
        ({"perimeters": 1, "line_width": 0.5e-3}, "walls of 1.6 lines of 0.5 mm"),
        ({"grading": 2.0}, "walls of 1.33 to 2.67 lines of 0.4 mm"),
        (MANY | {"nozzle": 0.6e-3}, "walls of 0.833 lines and gaps of 0.9 lines of 0.6 mm"),
        ({"slicer": "prusa", "pattern": "grid", "infill": 0.2}, ""),
        ({"slicer": "prusa", "pattern": "stars", "infill": 0.48}, "gaps of 0.98 lines of 0.45 mm"),
    ],
)
def test_what_does_not_print_is_said(lattice, wrong):
    assert what_does_not_print(lattice_with(**lattice)) == wrong


def test_walls_of_a_structure_are_judged_too():
    """Its gaps are not known."""
    found = [
        what_does_not_print(lattice_with(kind="custom", structure=structure(**ROD, **walls)))
        for walls in ({"wall_thickness_mm": 0.8}, {"wall_thickness_mm": 1.0})
    ]
    assert found == ["", "walls of 2.5 lines of 0.4 mm"]


def test_a_grid_keeps_what_prints_and_counts_the_rest(load):
    kept = load(KEPT)
    assert [case.lattice.wall_thickness for case in expand(kept)] == [0.4e-3, 0.8e-3]
    assert kept.left_out.impossible == 1
    assert load(KEPT.replace("true", "false")).left_out.impossible == 0


def test_what_does_not_print_is_refused_if_nothing_else_is_left(lines):
    (line,) = lines('[lattice]\nprintable = true\nwall_thickness = "0.6 mm"')
    assert line.startswith("lattice.printable = true: does not fit; allowed: false")
    assert "1.5 lines of 0.4 mm" in line
    (line,) = lines(KEPT.replace('"0.4 mm", "0.6 mm", "0.8 mm"', '"0.5 mm", "0.6 mm"'))
    assert line.endswith("walls of 1.25 lines of 0.4 mm do not print (2 of 2 combinations)")


def test_other_faults_are_not_left_out(load):
    with pytest.raises(ConfigError, match="below half the width"):
        load(KEPT.replace("0.6 mm", "5 mm"))


def test_what_prints_has_the_id_that_it_has_without_the_key():
    assert Case.of(lattice=dict(printable=True)).case_id == Case.of().case_id
    assert Case.of(lattice=dict(nozzle=0.2e-3)).case_id == Case.of().case_id
