"""Designs as text: columns that differ, with units."""

import pytest

from sweep.config.kinds.cells import Cells
from sweep.ranking.rank import ranked
from sweep.report.tables.design_text import NEUTRAL, about_direction, design_labels, design_text
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import summary

NAN = float("nan")


@pytest.mark.parametrize(
    ("key", "values", "head", "texts"),
    [
        ("material.loss", (0.2, 0.45), "loss %", ["20", "45"]),
        ("material.reference_time", (1e-3, 0.5), "reference time ms", ["1", "500"]),
        ("material.softening_m", (5e5, 2e6), "softening m MPa", ["0.5", "2"]),
        ("material.softening_r", (2.0, 3.0), "softening r", ["2", "3"]),
        ("lattice.layer_height", (2e-4, NAN), "layer height um", ["200", "–"]),
        ("material.memory", ("none", "measured"), "memory", ["none", "measured"]),
    ],
)
def test_grid_keys_are_shown_with_their_units(key, values, head, texts):
    table = summary(*({key: value} for value in values))
    (sheet,) = ranking_sheets(ranked(table, by="mass_g"), table)
    assert sheet.columns[sheet.heads.index(head)] == texts
    unit = head.removeprefix(key.split(".")[1].replace("_", " "))
    label = f"{head.removesuffix(unit)} {texts[0]}{unit}"
    assert design_labels(table, table)[0] == label
    (sheet,) = ranking_sheets(ranked(table[:1], by="mass_g"), table[:1])
    assert head not in sheet.heads  # it does not vary


def test_a_label_leaves_out_what_changes_nothing_if_the_rest_tells_the_design():
    keys = ("lattice.grading", "lattice.perimeters", "wall_thickness_m")
    rows = (1.0, 0, 4e-4), (2.0, 0, 5e-4), (1.0, 1, 6e-4)
    table = summary(*(dict(zip(keys, row, strict=True)) for row in rows))
    labels = ["wall 0.4 mm", "wall 0.5 mm, grading 2", "wall 0.6 mm, perimeters 1"]
    assert design_labels(table, table) == labels
    table = summary({"lattice.grading": 1.0}, {"lattice.grading": 2.0})
    assert design_labels(table, table) == ["grading 1", "grading 2"]


def test_what_changes_nothing_is_the_default_of_cells():
    fields = Cells.model_fields
    usual = {"grading": fields["grading"].default, "perimeters": fields["perimeters"].default}
    assert {name: f"{value:g}" for name, value in usual.items()} == NEUTRAL


def test_designs_of_a_slicer_are_told_by_their_share_instead_of_cells():
    table = summary({"infill_share": 0.2, "cells_x": 5}, {"infill_share": 0.3}, {"cells_x": 4})
    assert list(design_text(table, table)["infill %"]) == ["20", "30", ""]
    labels = ["cells 5 x 3, 20 % infill", "cells 3 x 3, 30 % infill", "cells 4 x 3"]
    assert design_labels(table, table) == labels
    laid = table.head(2)
    assert "cells" not in design_text(laid, laid)
    table["lattice.infill"] = [0.2, 0.3, 0.25]
    assert "infill" not in design_text(table, table)
    table["infill_share"] = NAN
    assert list(design_text(table, table)["infill %"]) == ["20", "30", "25"]


def test_a_slicer_is_named_where_there_are_two():
    """Designs of the only one have a share of infill."""
    rows = [{"lattice.slicer": slicer, "infill_share": 0.2} for slicer in ("orca", "cura")]
    one, two = summary({"lattice.slicer": ""}, rows[0]), summary({"lattice.slicer": ""}, *rows)
    assert list(design_text(one, one)) == ["infill %"]
    assert list(design_text(two, two)) == ["infill %", "slicer"]


UPRIGHT = {"direction": "out_of_plane", "solid_strain": 0.7, "peak_strain": 0.6}


@pytest.mark.parametrize(("depths", "shown"), [((13.0, 12.6), False), ((13.0, 14.0), True)])
def test_depth_of_a_plan_over_all_is_no_size_of_its_own(depths, shown):
    walls = zip((0.8, 0.4), depths, strict=True)
    rows = [{"wall_thickness_m": 1e-3 * t, "depth_m": 1e-3 * d} | UPRIGHT for t, d in walls]
    table = summary({}, *rows)
    assert ("depth mm" in design_text(table, table)) == shown


def test_what_plates_and_layers_leave_out_is_told():
    rows = summary({}, UPRIGHT, UPRIGHT | {"peak_strain": 0.8}, {"lattice_kind": "lateral-lattice"})
    none, usual, beyond, layered = (about_direction(row) for _, row in rows.iterrows())
    assert (none, len(usual), beyond[0]) == ([], 1, usual[0])
    assert layered == [usual[0].replace("its cells", "its print axis")]
    assert "beyond a strain of 70 %" in beyond[1]


def test_drawings_are_named_once_and_custom_structures_by_their_files():
    drawn = [{"lattice.file": "a.svg", "lattice_kind": "a.svg"}, {"lattice.file": ""}]
    table = summary(*drawn)
    assert list(design_text(table, table)) == ["pattern"]
    custom = summary(*({"lattice.file": f, "lattice_kind": "custom"} for f in ("a.json", "b.json")))
    assert list(design_text(custom, custom)["file"]) == ["a.json", "b.json"]
