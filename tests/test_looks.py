"""One design looks the same wherever it is drawn, and the legend says how."""

import pytest
from specimens import summary

from sweep.looks import looks


@pytest.fixture
def designs():
    cells, walls = [10, 2, 3, 2], [0.8e-3, 0.4e-3, 0.8e-3, 0.8e-3]
    return summary(
        *(
            {"cells_x": n, "cells_y": n, "wall_thickness_m": t}
            for n, t in zip(cells, walls, strict=True)
        )
    )


def test_colours_go_by_number_of_cells(designs):
    colors = looks(designs).colors
    assert list(colors) == [(2, 2), (3, 3), (10, 10)]
    assert colors[2, 2] == "#440154"
    assert len({*colors.values()}) == 3


def test_a_design_keeps_its_look_in_a_part_of_the_ranking(designs):
    of = looks(designs).of
    whole, part = of(designs), of(designs.tail(1))
    assert (part["c"][0], part["s"][0]) == (whole["c"][3], whole["s"][3])
    assert part["marker"] == whole["marker"]
    assert whole["s"][1] < whole["s"][0]


def test_legend_lists_what_varies_under_headings(designs):
    entries = [entry["label"] for entry in looks(designs).legend()]
    assert entries == ["cells", "2 x 2", "3 x 3", "10 x 10", "wall", "0.4 mm", "0.8 mm"]
    assert "wall" not in [entry["label"] for entry in looks(designs).legend(walls=False)]


def test_materials_have_signs(designs):
    designs["material"] = ["cheetah", "ninjaflex"] * 2
    signs = looks(designs).signs
    assert list(signs) == ["cheetah", "ninjaflex"]
    assert len({*signs.values()}) == 2
